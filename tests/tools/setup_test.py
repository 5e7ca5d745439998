# SPDX-License-Identifier: Apache-2.0
"""Tests tools/setup on a synthetic system, whose apt-get and dpkg-query record their calls."""
import os
import subprocess
import unittest

from tool import TOOLS, ToolTest

STUB = """#!/bin/sh
echo "$0 $*" >>{folder}/calls
exit {code}
"""


class SetupTest(ToolTest):
    def setUp(self):
        super().setUp()
        # Fake programs: dpkg-query finds no package, and apt-get has none to install.
        for name in ("apt-get", "dpkg-query", "apt-cache", "sudo"):
            self.write(name, STUB.format(folder=self.folder, code=1))
            os.chmod(self.path(name), 0o755)

    def run_on(self, system, *arguments):
        """Runs tools/setup on a system with this os-release file. Returns the exit code, the output, and the recorded
        calls."""
        self.write("os-release", system)
        environment = os.environ | {"PATH": f"{self.folder}:{os.environ['PATH']}", "MANDELMARCH_OS_RELEASE": self.path("os-release")}
        done = subprocess.run(["bash", os.path.join(TOOLS, "setup"), *arguments], capture_output=True, text=True, env=environment,
                              check=False)
        return done.returncode, done.stderr, self.read("calls") if os.path.exists(self.path("calls")) else ""

    def test_another_system_gets_a_list_and_no_packages(self):
        for system in ("NAME=Ubuntu\nID=ubuntu\nID_LIKE=debian\n", "ID=fedora\n", ""):
            code, said, calls = self.run_on(system)
            self.assertEqual((code, said.count("\n"), calls), (0, 1, ""), system)
            self.assertIn(" ninja-build ", said)
            self.assertIn("kokkos", said)

    def test_on_debian_apt_get_installs_packages(self):
        for system in ("ID=debian\n", 'PRETTY_NAME="x"\nID="debian"\n'):
            code, said, calls = self.run_on(system)
            self.assertEqual(code, 1)
            self.assertIn("apt-get failed", said)
            self.assertIn("apt-get update", calls)

    def test_a_package_that_a_debian_lacks_is_named(self):
        # All packages are installed, except that apt-cache has base-files only, and the offloading compiler is missing.
        self.write("dpkg-query", "#!/bin/sh\ncase $* in *gcc-offload-nvptx*) ;; *) echo installed ;; esac\n")
        self.write("apt-cache", "#!/bin/sh\n[ \"$2\" = base-files ]\n")
        code, said, calls = self.run_on("ID=debian\n", "build")
        self.assertEqual((code, said, calls), (0, "setup: this Debian has no package gcc-offload-nvptx: what needs it is left out\n", ""))

    def test_missing_packages_are_listed_without_installing(self):
        code, said, calls = self.run_on("ID=debian\n", "--check", "build")
        self.assertEqual((code, said.count("\n")), (1, 1))
        self.assertNotIn("apt-get", calls)


if __name__ == "__main__":
    unittest.main()
