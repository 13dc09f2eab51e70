# Writes the registry OUTPUT of all subcommands: every function `add_NAME` of the files beside this one that takes
# the program. The file stays as it is if it would not change.
file(GLOB command_files ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
set(names)
foreach(command_file IN LISTS command_files)
  file(STRINGS ${command_file} lines REGEX "^void add_[a-z0-9_]+\\(CLI::App& program, Invocation& invocation\\)")
  list(TRANSFORM lines REPLACE "^void add_([a-z0-9_]+).*" "\\1")
  list(APPEND names ${lines})
endforeach()
list(SORT names)
foreach(name IN LISTS names)
  string(APPEND JND_SUBCOMMAND_DECLARATIONS
    "HelpPlace place_of_${name}();\nvoid add_${name}(CLI::App& program, Invocation& invocation);\n")
  string(APPEND JND_SUBCOMMAND_ROWS "      {place_of_${name}(), add_${name}},\n")
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/registry.cpp.in ${OUTPUT} @ONLY)
