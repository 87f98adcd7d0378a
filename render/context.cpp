#include "render/context.hpp"

#include <GL/osmesa.h>
#include <GL/glext.h>
#include <fmt/format.h>

#include <string>

#include "core/error.hpp"

#ifdef __SANITIZE_ADDRESS__
// Mesa 22.3 itself loses some hundred bytes a context, destroyed properly or not: not ours to report.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa"; }
#endif

namespace ricochet::render {
namespace {

constexpr int samples = 2;  // along each side of a pixel

const char* vertex_shader = R"(#version 330 core
layout(location = 0) in vec2 place;
layout(location = 1) in vec3 colour;
flat out vec3 shade;
void main() { gl_Position = vec4(place, 0.0, 1.0); shade = colour; })";

const char* fragment_shader = R"(#version 330 core
flat in vec3 shade;
out vec4 pixel;
void main() { pixel = vec4(shade, 1.0); })";

template <class Function>
Function gl(const char* name) {
  const auto function = reinterpret_cast<Function>(OSMesaGetProcAddress(name));
  if (!function) throw Error(fmt::format("OSMesa lacks {}", name));
  return function;
}

}  // namespace

struct Context::Implementation {
  int width, height;
  OSMesaContext context = nullptr;
  std::vector<std::uint8_t> pixels;  // RGBA at the samples' resolution
  GLuint program = 0, buffer = 0, array = 0;
  ~Implementation() {
    if (context) OSMesaDestroyContext(context);
  }
};

Context::Context(int width, int height) : implementation_(std::make_unique<Implementation>()) {
  if (width < 16 || height < 16 || width > 7680 || height > 4320)
    throw FieldError("size", fmt::format("a picture has 16 x 16 to 7680 x 4320 pixels, not {} x {}", width, height));
  Implementation& i = *implementation_;
  i.width = width, i.height = height;
  const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 0, OSMESA_PROFILE, OSMESA_CORE_PROFILE, OSMESA_CONTEXT_MAJOR_VERSION, 3,
                            OSMESA_CONTEXT_MINOR_VERSION, 3, 0};
  i.context = OSMesaCreateContextAttribs(attributes, nullptr);
  i.pixels.resize(static_cast<std::size_t>(samples * width) * static_cast<std::size_t>(samples * height) * 4);
  if (!i.context || !OSMesaMakeCurrent(i.context, i.pixels.data(), GL_UNSIGNED_BYTE, samples * width, samples * height))
    throw Error(fmt::format("OSMesa cannot make a picture of {} x {} pixels", width, height));
  OSMesaPixelStore(OSMESA_Y_UP, 0);

  const auto create_shader = gl<PFNGLCREATESHADERPROC>("glCreateShader");
  const auto shader_source = gl<PFNGLSHADERSOURCEPROC>("glShaderSource");
  const auto compile = gl<PFNGLCOMPILESHADERPROC>("glCompileShader");
  const auto attach = gl<PFNGLATTACHSHADERPROC>("glAttachShader");
  i.program = gl<PFNGLCREATEPROGRAMPROC>("glCreateProgram")();
  for (const auto& [kind, text] : {std::pair{GL_VERTEX_SHADER, vertex_shader}, std::pair{GL_FRAGMENT_SHADER, fragment_shader}}) {
    const GLuint shader = create_shader(static_cast<GLenum>(kind));
    shader_source(shader, 1, &text, nullptr);
    compile(shader);
    attach(i.program, shader);
  }
  gl<PFNGLLINKPROGRAMPROC>("glLinkProgram")(i.program);
  GLint linked = 0;
  gl<PFNGLGETPROGRAMIVPROC>("glGetProgramiv")(i.program, GL_LINK_STATUS, &linked);
  if (!linked) throw Error("OSMesa cannot link the shaders");
  gl<PFNGLGENVERTEXARRAYSPROC>("glGenVertexArrays")(1, &i.array);
  gl<PFNGLBINDVERTEXARRAYPROC>("glBindVertexArray")(i.array);
  gl<PFNGLGENBUFFERSPROC>("glGenBuffers")(1, &i.buffer);
  gl<PFNGLBINDBUFFERPROC>("glBindBuffer")(GL_ARRAY_BUFFER, i.buffer);
  const auto pointer = gl<PFNGLVERTEXATTRIBPOINTERPROC>("glVertexAttribPointer");
  const auto enable = gl<PFNGLENABLEVERTEXATTRIBARRAYPROC>("glEnableVertexAttribArray");
  pointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
  pointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), reinterpret_cast<const void*>(2 * sizeof(float)));
  enable(0), enable(1);
}

Context::~Context() = default;

Image Context::draw(const std::vector<Vertex>& triangles, float red, float green, float blue) {
  Implementation& i = *implementation_;
  OSMesaMakeCurrent(i.context, i.pixels.data(), GL_UNSIGNED_BYTE, samples * i.width, samples * i.height);
  glViewport(0, 0, samples * i.width, samples * i.height);
  glClearColor(red, green, blue, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  gl<PFNGLUSEPROGRAMPROC>("glUseProgram")(i.program);
  gl<PFNGLBUFFERDATAPROC>("glBufferData")(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(Vertex)), triangles.data(), GL_STREAM_DRAW);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.size()));
  glFinish();

  Image image{i.width, i.height, std::vector<std::uint8_t>(static_cast<std::size_t>(i.width) * i.height * 3)};
  const std::size_t row = static_cast<std::size_t>(samples * i.width) * 4;
  for (int y = 0; y < i.height; ++y)
    for (int x = 0; x < i.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int sy = 0; sy < samples; ++sy)
          for (int sx = 0; sx < samples; ++sx) sum += i.pixels[(samples * y + sy) * row + (samples * x + sx) * 4 + c];
        image.rgb[(static_cast<std::size_t>(y) * i.width + x) * 3 + c] = static_cast<std::uint8_t>((sum + samples * samples / 2) / (samples * samples));
      }
  return image;
}

}  // namespace ricochet::render
