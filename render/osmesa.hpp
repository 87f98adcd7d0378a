#pragma once
// OSMesa's functions and OpenGL's, by name, from the library loaded when the first is asked for.

#include <string>

#define GL_GLEXT_PROTOTYPES  // declared, never linked: for their types
#include <GL/osmesa.h>

// After it: the types of GL come from there.
#include <GL/glext.h>

namespace ricochet::render {

/// A function of libOSMesa itself. Throws FileError naming Debian's package if the library is not there.
void* osmesa_symbol(const char* name);
/// A function of OpenGL, of the current context.
void* gl_symbol(const char* name);

template <class Function>
Function osmesa(const char* name) {
  return reinterpret_cast<Function>(osmesa_symbol(name));
}
template <class Function>
Function gl(const char* name) {
  return reinterpret_cast<Function>(gl_symbol(name));
}

}  // namespace ricochet::render
