# Writes OUT: a C++ file that defines VARIABLE in NAMESPACE as the text of FILE, in pieces that every
# compiler takes (C++ asks for string literals of at most 65536 characters).
file(READ ${FILE} text)
string(LENGTH "${text}" length)
set(pieces "")
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 12000 piece)
  string(APPEND pieces "R\"malus~(${piece})malus~\"\n")
  math(EXPR at "${at} + 12000")
endwhile()
file(WRITE ${OUT} "#include <string_view>\nnamespace ${NAMESPACE} {\nextern const std::string_view ${VARIABLE};\nconst std::string_view ${VARIABLE} =\n${pieces};\n}\n")
