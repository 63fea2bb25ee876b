# A digest of the headers that modules may include, so that a module that was built with others is told from one that fits:
# no size shows that a virtual function was added or that two fields were swapped. Comments and white space do not count.
#
# interface_digest(digest <folder of the wings> header...): 8 hexadecimal digits
function(interface_digest result folder)
  set(all "")
  foreach(header ${ARGN})
    file(READ ${folder}/${header} text)
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REGEX REPLACE "[ \t\r\n]+" " " text "${text}")
    string(APPEND all "${header}:${text}\n")
  endforeach()
  string(SHA256 digest "${all}")
  string(SUBSTRING ${digest} 0 8 digest)
  set(${result} ${digest} PARENT_SCOPE)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)  # cmake -D FOLDER=. -P cmake/interface_digest.cmake prints it
  include(${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake)
  interface_digest(digest ${FOLDER} ${public_headers} ${toolkit_headers})
  message(STATUS ${digest})
endif()
