#include "render/osmesa.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

#ifdef __SANITIZE_ADDRESS__
// Mesa 22.3 itself loses some hundred bytes a context, destroyed properly or not: not ours to report.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa"; }
#endif

namespace ricochet::render {

namespace {

// Drawing is always Mesa's own, by the processor: what the user's environment asks of Mesa for other programs (WSL
// exports GALLIUM_DRIVER=d3d12, say) would crash it here, or draw other pixels.
void* load_osmesa() {
  std::vector<std::string> names;
  for (char** variable = environ; *variable; ++variable) {
    const std::string_view text = *variable;
    for (const char* prefix : {"MESA_", "GALLIUM_", "GALLIVM_", "LP_", "ST_", "DRAW_", "TGSI_", "NIR_", "SOFTPIPE_"})
      if (text.starts_with(prefix)) names.emplace_back(text.substr(0, text.find('=')));
  }
  for (const std::string& name : names) unsetenv(name.c_str());
  setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  return dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
}

}  // namespace

void* osmesa_symbol(const char* name) {
  // Loaded alone: with libGL before it every pixel stays 0 without an error. Never unloaded: LLVM inside does not
  // survive that.
  static void* const library = load_osmesa();
  if (!library)
    throw FileError(fmt::format(
        "the OSMesa library, which draws without a display, is missing ({}); apt-get install libosmesa6", dlerror()));
  void* const symbol = dlsym(library, name);
  if (!symbol) throw Error(fmt::format("OSMesa lacks {}", name));
  return symbol;
}

void* gl_symbol(const char* name) {
  static const auto address = osmesa<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
  void* const symbol = reinterpret_cast<void*>(address(name));
  if (!symbol) throw Error(fmt::format("OSMesa lacks {}", name));
  return symbol;
}

}  // namespace ricochet::render
