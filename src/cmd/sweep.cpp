#include "cmd/verbs.h"
namespace espalier { int sweep_verb(const SweepOptions&) { return kBadInput; } }
