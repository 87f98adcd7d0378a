// What most files of this folder include, compiled once for all of them; each includes what it uses all the same.
#include "core/precompiled.hpp"
#include "effect/catalogue.hpp"
#include "impact/batch.hpp"
#include "script/reader.hpp"
