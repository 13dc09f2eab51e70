# Writes OUTPUT, which is the file TEMPLATE with ADD(NAME) for every NAME in place of @NAMES@. The names are those of
# the functions in FOLDER/*.cpp whose line begins with SIGNATURE. The output stays as it is if it would not change.
string(REGEX REPLACE "([()])" "\\\\\\1" pattern "^${SIGNATURE}")
string(REPLACE "NAME" "([a-z0-9_]+)" pattern "${pattern}")
file(GLOB files ${FOLDER}/*.cpp)
set(names)
foreach(file IN LISTS files)
  file(STRINGS ${file} lines REGEX "${pattern}")
  list(TRANSFORM lines REPLACE "${pattern}.*" "ADD(\\1)")
  list(APPEND names ${lines})
endforeach()
list(SORT names)
list(JOIN names " \\\n  " NAMES)
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
