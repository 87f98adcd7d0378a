# Writes the pages, styles and scripts of reports and lessons, and uPlot's, as texts of a C++ header: ricochet::page_source::NAME.
# Styles and scripts stand in an element of their own, after a new line, and bring the hash of that by which the page's policy knows
# them.
set(text "#pragma once\n// Made of render/report by page_sources.cmake.\n\n#include \"script/page_part.hpp\"\n\nnamespace ricochet::page_source {\n")
foreach(file head.html page.html player.html page.css uplot/uPlot.min.css uplot/uPlot.iife.js decode.js words.js replay.js player.js plots.js
    tables.js page.js lesson.html lesson.css lesson_graph.js lesson.js)
  file(READ ${SOURCE}/${file} content)
  string(REGEX REPLACE "[^a-zA-Z]" "_" name "${file}")
  if(file MATCHES "html$")
    string(APPEND text "inline constexpr const char ${name}[] = R\"~source~(${content})~source~\";\n")
  else()
    string(SHA256 hash "\n${content}")
    string(APPEND text "inline constexpr PagePart ${name}{R\"~source~(${content})~source~\", \"${hash}\"};\n")
  endif()
endforeach()
file(WRITE ${OUTPUT} "${text}}\n")
