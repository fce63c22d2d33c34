# Writes OUT: a C++ file with a function embedded_NAME() that returns all files PATTERN of DIR, as string
# literals (arrays of numbers compile seven times slower).
file(GLOB files ${DIR}/${PATTERN})
list(SORT files)
set(text "// Generated from ${PATTERN} of ${NAME}; do not edit.\n#include \"base/shared/embedded.hpp\"\n#pragma GCC diagnostic ignored \"-Woverlength-strings\"\nnamespace deck::detail {\n")
set(rows "")
foreach(f ${files})
  get_filename_component(name ${f} NAME)
  file(READ ${f} content)
  string(REPLACE "\\" "\\\\" content "${content}")
  string(REPLACE "\"" "\\\"" content "${content}")
  string(REPLACE "\r" "\\r" content "${content}")
  string(REPLACE "\n" "\\n\"\n\"" content "${content}")
  string(MAKE_C_IDENTIFIER ${name} id)
  string(APPEND text "static constexpr char data_${id}[] =\n\"${content}\";\n")
  string(APPEND rows "    {\"${name}\", {data_${id}, sizeof(data_${id}) - 1}},\n")
endforeach()
file(WRITE ${OUT} "${text}const std::vector<EmbeddedFile>& embedded_${NAME}() {
  static const std::vector<EmbeddedFile> all = {\n${rows}  };\n  return all;\n}\n}  // namespace deck::detail\n")
