# SPDX-License-Identifier: Apache-2.0
# The project's comments as Doxygen reads them: a file's first (behind its licence's line, which is none), those before
# what they are about, those behind it.
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
