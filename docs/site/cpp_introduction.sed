# What doxygen reads of docs/reference/cpp.md: words of links without their targets, and names of classes without backquotes.
s/\[([^]]*)\]\([^)]*\)/\1/g
s/`(jnd::[A-Za-z_:]+)`/\1/g
