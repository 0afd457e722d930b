# Writes a C++ source that holds text files as constants:
#   cmake -DOUT=x.cpp -DHEADER=run/report_assets.h -DFOLDER=folder -DTEXTS=kName=file+file,kOther=file -P embed.cmake
# Files joined by + become one text. Bytes are written as numbers: no limit of a compiler on literals applies.
set(text "// Written by cmake/embed.cmake.\n#include \"${HEADER}\"\n\nnamespace espalier {\nnamespace {\n")
set(views "")
string(REPLACE "," ";" TEXTS "${TEXTS}")
foreach(item IN LISTS TEXTS)
  string(REGEX MATCH "^([^=]+)=(.*)$" matched "${item}")
  set(name "${CMAKE_MATCH_1}")
  string(REPLACE "+" ";" files "${CMAKE_MATCH_2}")
  set(hex "")
  foreach(file IN LISTS files)
    file(READ "${FOLDER}/${file}" one HEX)
    string(APPEND hex "${one}")
  endforeach()
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
  string(REGEX REPLACE "(('[^']*',)('[^']*',)('[^']*',)('[^']*',)('[^']*',)('[^']*',)('[^']*',)('[^']*',))" "\\1\n"
         bytes "${bytes}")
  string(APPEND text "constexpr char ${name}Bytes[] = {\n${bytes}'\\0'};\n")
  string(APPEND views "const std::string_view ${name}{${name}Bytes, sizeof(${name}Bytes) - 1};\n")
endforeach()
string(APPEND text "\n}  // namespace\n\n${views}\n}  // namespace espalier\n")
file(WRITE "${OUT}" "${text}")
