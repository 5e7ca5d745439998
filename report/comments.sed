# SPDX-License-Identifier: Apache-2.0
# Converts this project's comments to Doxygen's syntax: the first one of a file (after the licence line, which is
# skipped), those before the code they describe, and those after it.
1{
    /SPDX-License-Identifier/{
        N
        s/^[^\n]*\n//
    }
    s,^// (.*),/// \\file\n/// \1,
}
s,^( *)// ,\1/// ,
s,^( *)//$,\1///,
s#([;{,)(]  ?)// #\1///< #
