# Writes a C++ file in which texts of assets stand as they are: cmake -DOUT=FILE -DASSETS=NAME=PATH,NAME=PATH -P this.
# The names are declared in assets.h.
set(text "// Made of the files in results/pages/assets by the build.\n#include \"results/pages/assets.h\"\n\nnamespace beltlife {\n\n")
string(REPLACE "," ";" assets "${ASSETS}")
foreach(asset ${assets})
  string(REPLACE "=" ";" pair "${asset}")
  list(GET pair 0 name)
  list(GET pair 1 path)
  file(READ ${path} content)
  string(APPEND text "const char* const ${name} = R\"asset(${content})asset\";\n\n")
endforeach()
string(APPEND text "}  // namespace beltlife\n")
file(WRITE ${OUT} "${text}")
