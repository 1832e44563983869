# Writes OUT from embed_text.cpp.in: VARIABLE in NAMESPACE is the text of FILE. The text is split into raw string
# literals because C++ guarantees at most 65536 characters per literal.
file(READ ${FILE} text)
string(LENGTH "${text}" length)
set(pieces "")
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 12000 piece)
  string(APPEND pieces "\nR\"malus~(${piece})malus~\"")
  math(EXPR at "${at} + 12000")
endwhile()
file(READ ${CMAKE_CURRENT_LIST_DIR}/embed_text.cpp.in template)
string(CONFIGURE "${template}" result @ONLY)
file(WRITE ${OUT} "${result}")
