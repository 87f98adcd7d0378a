// What most files of this folder include, compiled once for all of them; each includes what it uses all the same.
#include "core/precompiled.hpp"
#include "impact/engine.hpp"
#include "impact/launch/launch.hpp"
