# Makes OUTPUT, a C++ file that contains the page of SOURCE. The page includes its style and its JavaScript,
# which ESBUILD bundles with the d3 of D3_FOLDER. A content security policy with the digests of both lets a
# browser run these and nothing else.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed ERROR_VARIABLE why OUTPUT_VARIABLE out)
  if(failed)
    message(FATAL_ERROR "${why}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

foreach(file main.js style.css)
  run(${CMAKE_COMMAND} -E env NODE_PATH=${D3_FOLDER} ${ESBUILD} ${SOURCE}/${file} --bundle --minify
      --format=iife --target=es2020 --charset=utf8 --legal-comments=inline --log-level=warning
      --outfile=${WORK}/${file})
endforeach()

# Sets `result` to 'sha256-...', the digest of `file` as a content security policy writes it.
function(digest file result)
  file(SHA256 ${file} hex)
  string(TOUPPER ${hex} hex)
  file(WRITE ${file}.digest ${hex})
  run(sh -c "basenc --base16 --decode '${file}.digest' | base64")
  string(STRIP "${out}" base64)
  set(${result} "'sha256-${base64}'" PARENT_SCOPE)
endfunction()
digest(${WORK}/main.js script_digest)
digest(${WORK}/style.css style_digest)

file(READ ${SOURCE}/index.html page)
file(READ ${WORK}/main.js script)
file(READ ${WORK}/style.css style)
# Style and JavaScript are inserted last, so that {{...}} in their text is not replaced.
string(REPLACE "{{style_digest}}" "${style_digest}" page "${page}")
string(REPLACE "{{script_digest}}" "${script_digest}" page "${page}")
string(REPLACE "{{style}}" "${style}" page "${page}")
string(FIND "${page}" "{{data}}" data)
string(SUBSTRING "${page}" 0 ${data} before)
string(SUBSTRING "${page}" ${data} -1 after)
string(REPLACE "{{data}}\n" "" after "${after}")
string(REPLACE "{{script}}" "${script}" after "${after}")

set(begin "R\"page~(")
set(end ")page~\"")
file(
  WRITE ${OUTPUT}
  "// Made by analysis/explore/page.cmake.\n"
  "#include \"analysis/explore/page.hpp\"\n\n"
  "namespace grseg {\n"
  "const std::string_view page_before_data = ${begin}${before}${end};\n"
  "const std::string_view page_after_data = ${begin}${after}${end};\n"
  "}  // namespace grseg\n")
