#include "solution/small_solution.h"

// Writes a small solution to the file that the argument names, for fuzz_solution to begin with.
int main(int, char** arguments) { isolux::save_solution(isolux::small_solution(), arguments[1]); }
