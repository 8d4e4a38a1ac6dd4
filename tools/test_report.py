#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a JUnit file that ctest wrote; the counts go to standard output, the rest to standard error.

test_report.py RESULTS.xml    prints `PASSED FAILED SKIPPED`, three numbers, and explains to
standard error: each failed test with the end of what it said, each skipped one with its reason.
"""
import sys
import xml.etree.ElementTree as ElementTree

LAST_LINES = 40


def main():
    passed = failed = skipped = 0
    for case in ElementTree.parse(sys.argv[1]).getroot().iter("testcase"):
        output = (case.findtext("system-out") or "").strip().splitlines()
        if case.find("skipped") is not None:
            skipped += 1
            reason = next((line.strip() for line in reversed(output) if "skip" in line.lower()), "")
            print(f"  skipped: {case.get('name')}  {reason}", file=sys.stderr)
        elif case.find("failure") is not None or case.get("status") == "fail":
            failed += 1
            print(f"  FAILED: {case.get('name')}", file=sys.stderr)
            print("\n".join(f"    {line}" for line in output[-LAST_LINES:]), file=sys.stderr)
        else:
            passed += 1
    print(passed, failed, skipped)


if __name__ == "__main__":
    main()
