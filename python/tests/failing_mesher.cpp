// Fails an assertion within each meshing of TetGen's, for tests of what comes of it (LD_PRELOAD).
#undef NDEBUG
#include <cassert>

#include <tetgen.h>

void tetgenmesh::carveholes() { assert(in == nullptr); }
