# The project's comments as Doxygen reads them: a file's first, those before what they are about, those behind it.
1s,^// (.*),/// \\file\n/// \1,
s,^( *)// ,\1/// ,
s,^( *)//$,\1///,
s#([;{,)(]  ?)// #\1///< #
