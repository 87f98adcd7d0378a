# Writes the pages, styles and scripts of reports and lessons, and uPlot's, as texts of a C++ header: ricochet::page_source::NAME.
set(text "#pragma once\n// Made of render/report by page_sources.cmake.\n\nnamespace ricochet::page_source {\n")
foreach(file page.html player.html page.css uplot/uPlot.min.css uplot/uPlot.iife.js decode.js words.js replay.js player.js plots.js
    tables.js page.js lesson.html lesson.css lesson_graph.js lesson.js)
  file(READ ${SOURCE}/${file} content)
  string(REGEX REPLACE "[^a-zA-Z]" "_" name "${file}")
  string(APPEND text "inline constexpr const char ${name}[] = R\"~source~(${content})~source~\";\n")
endforeach()
file(WRITE ${OUTPUT} "${text}}\n")
