# Fails unless README holds the whole of EXAMPLE as a C++ block.
file(READ "${README}" readme)
file(READ "${EXAMPLE}" example)
string(FIND "${readme}" "```cpp\n${example}```\n" place)
if(place EQUAL -1)
  message(FATAL_ERROR "README.md and examples/velocity_invariant.cpp differ: copy the file into the README's C++ block")
endif()
