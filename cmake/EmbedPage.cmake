# Writes the C++ source that holds the page's template as text, for src/viz/page_template.hpp.
#
#   cmake -DOUTPUT=FILE -DPAGE=index.html -P EmbedPage.cmake
#   cmake -DOUTPUT=FILE -DMISSING=REASON -P EmbedPage.cmake

cmake_minimum_required(VERSION 3.25)

set(delimiter "trajet-page")
set(page "")
if(PAGE)
  file(READ "${PAGE}" page)
  foreach(part [[id="trajet-data">null</script>]] "</html>")
    string(FIND "${page}" "${part}" found)
    if(found EQUAL -1)
      message(FATAL_ERROR "${PAGE} lacks ${part}")
    endif()
  endforeach()
  string(FIND "${page}" ")${delimiter}\"" found)
  if(NOT found EQUAL -1)
    message(FATAL_ERROR "${PAGE} holds the delimiter of the raw string literal")
  endif()
endif()

file(WRITE "${OUTPUT}"
"#include \"viz/page_template.hpp\"

namespace trajet::detail {

const std::string_view kPageTemplate = R\"${delimiter}(${page})${delimiter}\";
const std::string_view kPageMissing = \"${MISSING}\";

}  // namespace trajet::detail
")
