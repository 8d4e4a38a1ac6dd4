# SPDX-License-Identifier: Apache-2.0
"""tools/check_layers.py on copies of the tree at argv[1], each with one thing wrong."""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
PARTS = ["src", "server", "client", "cli", "docs", "experiments"]


class CheckLayersTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        for part in PARTS:
            shutil.copytree(SOURCE / part, self.root / part)

    def tearDown(self):
        self.folder.cleanup()

    def check(self):
        run = subprocess.run([sys.executable, "-B", SOURCE / "tools/check_layers.py", self.root],
                             stdout=subprocess.PIPE, text=True, check=False)
        return run.returncode, run.stdout.splitlines()

    def add(self, file, first_line):
        path = self.root / file
        path.write_text(first_line + "\n" + (path.read_text() if path.exists() else ""))

    def replace(self, file, old, new):
        text = (self.root / file).read_text()
        self.assertIn(old, text)
        (self.root / file).write_text(text.replace(old, new, 1))

    def expect_only(self, *problems):
        code, lines = self.check()
        self.assertEqual(lines, list(problems))
        self.assertEqual(code, 1)

    def test_the_tree_itself_is_in_order(self):
        code, lines = self.check()
        self.assertEqual((code, len(lines)), (0, 1), lines)

    def test_a_module_includes_no_module_of_a_higher_layer(self):
        self.add("src/semview/core/bad.hpp", '#include "semview/view/column_view.hpp"')
        self.expect_only(
            "src/semview/core/bad.hpp:1: core may not include semview/view/column_view.hpp",
            "src/semview/core/CMakeLists.txt: core includes headers of view and does not link it")

    def test_the_cache_knows_no_caster(self):
        self.add("src/semview/cache/bad.cpp", "#include <embree3/rtcore.h>")
        self.expect_only(
            "src/semview/cache/bad.cpp:1: cache may not include <embree3/rtcore.h> of Embree")

    def test_a_library_that_nobody_listed_is_not_included(self):
        self.add("src/semview/view/bad.cpp", "#include <boost/array.hpp>")
        self.expect_only("src/semview/view/bad.cpp:1: <boost/array.hpp> is of no library that "
                         "tools/check_layers.py knows")

    def test_the_server_does_not_include_the_client(self):
        self.add("server/methods.cpp", '#include "client/lib/connection.hpp"')
        self.expect_only(
            "server/methods.cpp:1: server may not include client/lib/connection.hpp",
            "server/CMakeLists.txt: server includes headers of client/lib and does not link it")

    def test_the_client_library_casts_nothing(self):
        self.add("client/lib/connection.cpp", '#include "semview/raycast/scene.hpp"')
        self.expect_only(
            "client/lib/connection.cpp:1: client/lib may not include semview/raycast/scene.hpp",
            "client/lib/CMakeLists.txt: client/lib includes headers of raycast and does not link it")

    def test_the_robot_does_not_know_the_connection(self):
        self.add("client/robot/localizer.cpp", '#include "client/lib/connection.hpp"')
        code, lines = self.check()
        self.assertEqual(code, 1)
        self.assertIn("client/robot/localizer.cpp:1: client/robot may not include "
                      "client/lib/connection.hpp", lines)

    def test_the_command_line_opens_no_store_of_its_own(self):
        self.add("cli/main.cpp", "#include <lmdb.h>")
        self.expect_only("cli/main.cpp:1: cli may not include <lmdb.h> of LMDB")

    def test_a_robot_includes_nothing_of_the_server(self):
        self.add("client/robot/localizer.cpp", '#include "server/server.hpp"')
        self.expect_only(
            "client/robot/localizer.cpp:1: client/robot may not include server/server.hpp",
            "client/robot/CMakeLists.txt: client/robot includes headers of server and does not link it")

    def test_a_header_of_another_folder_needs_its_full_name(self):
        self.add("client/lib/connection.cpp", '#include "../../server/sockets.hpp"')
        self.add("server/main.cpp", '#include "connection.hpp"')
        self.expect_only(
            'server/main.cpp:1: "connection.hpp" is no file of server; other modules by their full '
            "names",
            'client/lib/connection.cpp:1: "../../server/sockets.hpp" is no file of client/lib; other '
            "modules by their full names")

    def test_a_module_links_what_it_includes(self):
        self.replace("src/semview/raycast/CMakeLists.txt", "USES core geometry semantics view map",
                     "USES core geometry semantics view")
        self.expect_only(
            "src/semview/raycast/CMakeLists.txt: raycast includes headers of map and does not link it")

    def test_a_module_links_nothing_that_it_does_not_include(self):
        self.replace("src/semview/semantics/CMakeLists.txt", "USES core", "USES core\n    # why\n    map")
        self.expect_only("src/semview/semantics/CMakeLists.txt:6: semantics links map and includes no "
                         "header of it")

    def test_a_library_is_linked_only_where_the_table_has_it(self):
        self.replace("server/CMakeLists.txt", "cppzmq)", "cppzmq embree)")
        code, lines = self.check()
        self.assertEqual(code, 1)
        self.assertRegex("\n".join(lines), r"^server/CMakeLists.txt:\d+: server may not link embree$")

    def test_a_new_folder_is_a_module_that_the_table_must_have(self):
        (self.root / "src/semview/newcomer").mkdir()
        self.expect_only(
            "src/semview/newcomer: a module that tools/check_layers.py does not know")

    def test_the_page_on_architecture_has_the_same_table(self):
        self.replace("docs/architecture.md", "| LMDB |", "| LMDB, OpenCV |")
        code, lines = self.check()
        self.assertEqual((code, len(lines)), (1, 1))
        self.assertRegex(lines[0], r"^docs/architecture.md:\d+: libraries of cache other than in "
                                   r"tools/check_layers.py: LMDB$")


if __name__ == "__main__":
    unittest.main()
