// SPDX-License-Identifier: Apache-2.0
#include "report_files.hpp"

#include "calibration.hpp"
#include "figures.hpp"
#include "semview/io/text_file.hpp"

namespace semview::paper2017 {

Result<std::string> write_report(const Results& results,
                                 const ReportHeader& header,
                                 const std::filesystem::path& directory) {
  std::string page = report(results, header);
  SEMVIEW_TRY_STATUS(io::write_text_file(directory / "report.md", page));
  SEMVIEW_TRY_STATUS(
      io::write_text_file(directory / "calibration.md", calibration_page(results, header)));
  SEMVIEW_TRY_STATUS(write_fig2(results, directory));
  SEMVIEW_TRY_STATUS(write_fig3(results, directory));
  SEMVIEW_TRY_STATUS(write_fig4(results, directory));
  return page;
}

}  // namespace semview::paper2017
