#include "render/context.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "core/error.hpp"
#include "render/osmesa.hpp"

namespace ricochet::render {
namespace {

// Places are in pixels of the painting, y down. llvmpipe's time goes by triangles and by what is interpolated in them,
// so that is one vector; the values of springs come with the program that colours them.
const char* mesh_vertex_shader = R"(
layout(location = 0) in vec2 place;
layout(location = 1) in vec4 of_material;
uniform vec2 size;
out vec4 inside;
#ifdef SPRINGS_COLOURED
layout(location = 2) in vec3 of_springs;
flat out vec3 spring;
#endif
void main() {
  gl_Position = vec4(2.0 * place.x / size.x - 1.0, 1.0 - 2.0 * place.y / size.y, 0.0, 1.0);
  inside = of_material;
#ifdef SPRINGS_COLOURED
  spring = of_springs;
#endif
})";

// A spring is drawn by half from either side of it.
const char* mesh_fragment_shader = R"(
in vec4 inside;  // value of the material, distances from the three sides
uniform sampler2D colours;
uniform bool material_coloured;
uniform vec4 body, ink;
uniform float half_width;
out vec4 pixel;
vec3 coloured(float v) { return texelFetch(colours, ivec2(clamp(v, 0.0, 1.0) * 255.0 + 0.5, 0), 0).rgb; }
#ifdef SPRINGS_COLOURED
flat in vec3 spring;
void main() {
  vec3 cover = clamp(half_width + 0.5 - inside.yzw, 0.0, 1.0);
  vec3 colour = mix(body.rgb, coloured(spring.x), cover.x);
  pixel = vec4(mix(mix(colour, coloured(spring.y), cover.y), coloured(spring.z), cover.z), 1.0);
}
#else
void main() {
  vec3 colour = material_coloured ? coloured(inside.x) : body.rgb;
  float cover = clamp(half_width + 0.5 - min(inside.y, min(inside.z, inside.w)), 0.0, 1.0);
  pixel = vec4(mix(colour, ink.rgb, cover * ink.a), 1.0);
}
#endif
)";

const char* shape_vertex_shader = R"(
layout(location = 0) in vec2 place;
layout(location = 1) in vec4 ink;
layout(location = 2) in vec4 stroke;
uniform vec2 size;
out vec4 colour;
out vec2 at;
flat out vec2 shape;
void main() {
  gl_Position = vec4(2.0 * place.x / size.x - 1.0, 1.0 - 2.0 * place.y / size.y, 0.0, 1.0);
  colour = ink, at = stroke.xy, shape = stroke.zw;
})";

const char* shape_fragment_shader = R"(
in vec4 colour;
in vec2 at;
flat in vec2 shape;
uniform sampler2D atlas;
out vec4 pixel;
void main() {
  float cover = 1.0;
  if (shape.x < 0.0) cover = texelFetch(atlas, ivec2(at), 0).r;
  else if (shape.x > 0.0) {
    float along = max(0.0, max(-at.y, at.y - shape.y));
    cover = clamp(shape.x + 0.5 - length(vec2(at.x, along)), 0.0, 1.0);
  }
  pixel = vec4(colour.rgb, colour.a * cover);
})";

// The functions of OpenGL that are used here.
struct Gl {
#define RICOCHET_GL(name) decltype(&gl##name) name = gl<decltype(&gl##name)>("gl" #name)
  RICOCHET_GL(CreateShader);
  RICOCHET_GL(ShaderSource);
  RICOCHET_GL(CompileShader);
  RICOCHET_GL(CreateProgram);
  RICOCHET_GL(AttachShader);
  RICOCHET_GL(LinkProgram);
  RICOCHET_GL(GetProgramiv);
  RICOCHET_GL(UseProgram);
  RICOCHET_GL(GetUniformLocation);
  RICOCHET_GL(Uniform1i);
  RICOCHET_GL(Uniform1f);
  RICOCHET_GL(Uniform2f);
  RICOCHET_GL(Uniform4f);
  RICOCHET_GL(GenVertexArrays);
  RICOCHET_GL(BindVertexArray);
  RICOCHET_GL(GenBuffers);
  RICOCHET_GL(BindBuffer);
  RICOCHET_GL(BufferData);
  RICOCHET_GL(VertexAttribPointer);
  RICOCHET_GL(EnableVertexAttribArray);
  RICOCHET_GL(ActiveTexture);
  RICOCHET_GL(GenFramebuffers);
  RICOCHET_GL(BindFramebuffer);
  RICOCHET_GL(GenRenderbuffers);
  RICOCHET_GL(BindRenderbuffer);
  RICOCHET_GL(RenderbufferStorageMultisample);
  RICOCHET_GL(FramebufferRenderbuffer);
  RICOCHET_GL(CheckFramebufferStatus);
  RICOCHET_GL(BlitFramebuffer);
  RICOCHET_GL(GenTextures);
  RICOCHET_GL(BindTexture);
  RICOCHET_GL(TexImage2D);
  RICOCHET_GL(TexParameteri);
  RICOCHET_GL(PixelStorei);
  RICOCHET_GL(Viewport);
  RICOCHET_GL(Scissor);
  RICOCHET_GL(Enable);
  RICOCHET_GL(Disable);
  RICOCHET_GL(BlendFunc);
  RICOCHET_GL(ClearColor);
  RICOCHET_GL(Clear);
  RICOCHET_GL(DrawArrays);
  RICOCHET_GL(Finish);
#undef RICOCHET_GL
};

}  // namespace

void check_size(int width, int height) {
  if (width < least_size || height < least_size || width > most_width || height > most_height)
    throw FieldError("size", fmt::format("a picture has {} x {} to {} x {} pixels, not {} x {}", least_size, least_size,
                                         most_width, most_height, width, height));
}

struct Context::Implementation {
  int width = 0, height = 0, scale = 1, samples = 1;
  OSMesaContext context = nullptr;
  std::vector<std::uint8_t> pixels;  // RGBA
  std::unique_ptr<Gl> gl;
  GLuint mesh_program = 0, springs_program = 0, shape_program = 0, mesh_array = 0, shape_array = 0, mesh_buffer = 0,
         shape_buffer = 0, colours = 0, atlas = 0, frame = 0;
  int atlas_version = -1;

  ~Implementation() {
    if (context) osmesa<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext")(context);
  }
  void make_current() {
    if (!osmesa<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent")(context, pixels.data(), GL_UNSIGNED_BYTE, width,
                                                                   height))
      throw Error(fmt::format("OSMesa cannot make a picture of {} x {} pixels", width, height));
  }
  GLuint program(const char* vertex, const char* fragment, const char* definitions = "") const {
    const GLuint linked = gl->CreateProgram();
    for (const auto& [kind, text] : {std::pair{GL_VERTEX_SHADER, vertex}, std::pair{GL_FRAGMENT_SHADER, fragment}}) {
      const GLuint shader = gl->CreateShader(static_cast<GLenum>(kind));
      const char* parts[] = {"#version 330 core\n", definitions, text};
      gl->ShaderSource(shader, 3, parts, nullptr);
      gl->CompileShader(shader);
      gl->AttachShader(linked, shader);
    }
    gl->LinkProgram(linked);
    GLint good = 0;
    gl->GetProgramiv(linked, GL_LINK_STATUS, &good);
    if (!good) throw Error("OSMesa cannot link the shaders");
    return linked;
  }
  // Attributes of 32-bit floats, or of four bytes from 0 to 1, one after another in a vertex.
  void arrays(GLuint& array, GLuint& buffer, std::size_t stride,
              const std::vector<std::array<int, 3>>& attributes) const {  // {count, bytes?, offset}
    gl->GenVertexArrays(1, &array);
    gl->BindVertexArray(array);
    gl->GenBuffers(1, &buffer);
    gl->BindBuffer(GL_ARRAY_BUFFER, buffer);
    for (GLuint i = 0; i < attributes.size(); ++i) {
      const auto& [count, bytes, offset] = attributes[i];
      gl->VertexAttribPointer(i, count, bytes ? GL_UNSIGNED_BYTE : GL_FLOAT, bytes ? GL_TRUE : GL_FALSE,
                              static_cast<GLsizei>(stride),
                              reinterpret_cast<const void*>(static_cast<std::intptr_t>(offset)));
      gl->EnableVertexAttribArray(i);
    }
  }
  void texture(GLuint& name, GLenum unit) const {
    gl->ActiveTexture(unit);
    gl->GenTextures(1, &name);
    gl->BindTexture(GL_TEXTURE_2D, name);
    for (const GLenum which : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      gl->TexParameteri(GL_TEXTURE_2D, which, GL_NEAREST);
    for (const GLenum which : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
      gl->TexParameteri(GL_TEXTURE_2D, which, GL_CLAMP_TO_EDGE);
  }
  template <class Vertex>
  void draw_all(GLuint array, GLuint buffer, const std::vector<Vertex>& vertices) const {
    if (vertices.empty()) return;
    gl->BindVertexArray(array);
    gl->BindBuffer(GL_ARRAY_BUFFER, buffer);
    gl->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
                   GL_STREAM_DRAW);
    gl->DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
  }
  void draw_shapes(const std::vector<ShapeVertex>& shapes) const {
    if (shapes.empty()) return;
    gl->UseProgram(shape_program);
    gl->Enable(GL_BLEND);
    gl->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw_all(shape_array, shape_buffer, shapes);
    gl->Disable(GL_BLEND);
  }
  void set(GLuint of, const char* name, const Colour& c) const {
    gl->Uniform4f(gl->GetUniformLocation(of, name), c[0] / 255.0f, c[1] / 255.0f, c[2] / 255.0f, c[3] / 255.0f);
  }
};

Context::Context(int width, int height, Smoothing smoothing) : implementation_(std::make_unique<Implementation>()) {
  check_size(width, height);
  Implementation& i = *implementation_;
  i.width = width;
  i.height = height;
  i.scale = smoothing == Smoothing::supersample ? 2 : 1;
  i.samples = smoothing == Smoothing::multisample ? 4 : 0;
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  i.context = osmesa<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs")(attributes, nullptr);
  if (!i.context) throw Error("OSMesa cannot make a context of OpenGL 3.3");
  i.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  i.make_current();
  osmesa<decltype(&OSMesaPixelStore)>("OSMesaPixelStore")(OSMESA_Y_UP, 0);
  i.gl = std::make_unique<Gl>();
  i.mesh_program = i.program(mesh_vertex_shader, mesh_fragment_shader);
  i.springs_program = i.program(mesh_vertex_shader, mesh_fragment_shader, "#define SPRINGS_COLOURED\n");
  i.shape_program = i.program(shape_vertex_shader, shape_fragment_shader);
  i.arrays(
      i.mesh_array, i.mesh_buffer, sizeof(MeshVertex),
      {{2, 0, offsetof(MeshVertex, x)}, {4, 0, offsetof(MeshVertex, value)}, {3, 0, offsetof(MeshVertex, spring)}});
  i.arrays(i.shape_array, i.shape_buffer, sizeof(ShapeVertex),
           {{2, 0, offsetof(ShapeVertex, x)}, {4, 1, offsetof(ShapeVertex, colour)}, {4, 0, offsetof(ShapeVertex, u)}});
  i.texture(i.colours, GL_TEXTURE0);
  i.texture(i.atlas, GL_TEXTURE1);
  if (i.scale == 1 && i.samples == 0) return;
  GLuint buffer = 0;
  i.gl->GenFramebuffers(1, &i.frame);
  i.gl->BindFramebuffer(GL_FRAMEBUFFER, i.frame);
  i.gl->GenRenderbuffers(1, &buffer);
  i.gl->BindRenderbuffer(GL_RENDERBUFFER, buffer);
  i.gl->RenderbufferStorageMultisample(GL_RENDERBUFFER, i.samples, GL_RGBA8, i.scale * width, i.scale * height);
  i.gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer);
  if (i.gl->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw FieldError("smoothing", fmt::format("OSMesa cannot smooth a picture of {} x {} pixels this way; choose lines",
                                              width, height));
}

Context::~Context() = default;

int Context::scale() const { return implementation_->scale; }

Image Context::draw(const Painting& painting, const Font& font) {
  Implementation& i = *implementation_;
  i.make_current();
  const Gl& gl = *i.gl;
  const int width = i.scale * i.width, height = i.scale * i.height;
  gl.BindFramebuffer(GL_FRAMEBUFFER, i.frame);
  gl.Viewport(0, 0, width, height);
  gl.Disable(GL_SCISSOR_TEST);
  gl.ClearColor(1, 1, 1, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.ActiveTexture(GL_TEXTURE0);
  if (!painting.colours.empty())
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, static_cast<GLsizei>(painting.colours.size()), 1, 0, GL_RGBA,
                  GL_UNSIGNED_BYTE, painting.colours.data());
  gl.ActiveTexture(GL_TEXTURE1);
  if (i.atlas_version != font.version()) {
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, Font::side, Font::side, 0, GL_RED, GL_UNSIGNED_BYTE, font.atlas().data());
    i.atlas_version = font.version();
  }
  const GLuint mesh_program = painting.springs_coloured ? i.springs_program : i.mesh_program;
  for (const GLuint program : {mesh_program, i.shape_program}) {
    gl.UseProgram(program);
    gl.Uniform2f(gl.GetUniformLocation(program, "size"), static_cast<float>(width), static_cast<float>(height));
  }
  gl.Uniform1i(gl.GetUniformLocation(i.shape_program, "atlas"), 1);
  gl.UseProgram(mesh_program);
  gl.Uniform1i(gl.GetUniformLocation(mesh_program, "colours"), 0);
  gl.Uniform1i(gl.GetUniformLocation(mesh_program, "material_coloured"), painting.material_coloured);
  i.set(mesh_program, "body", painting.body);
  for (const Panel& panel : painting.panels) {
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(panel.x, height - panel.y - panel.height, panel.width, panel.height);
    gl.UseProgram(mesh_program);
    gl.Uniform1f(gl.GetUniformLocation(mesh_program, "half_width"),
                 panel.half_width > 0 ? static_cast<float>(panel.half_width) : -1.0f);
    i.set(mesh_program, "ink", panel.ink);
    i.draw_all(i.mesh_array, i.mesh_buffer, panel.mesh);
    i.draw_shapes(panel.above);
  }
  gl.Disable(GL_SCISSOR_TEST);
  i.draw_shapes(painting.over);
  if (i.frame) {
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, i.frame);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl.BlitFramebuffer(0, 0, width, height, 0, 0, i.width, i.height, GL_COLOR_BUFFER_BIT,
                       i.scale > 1 ? GL_LINEAR : GL_NEAREST);
  }
  gl.Finish();
  return {i.width, i.height, i.pixels};
}

}  // namespace ricochet::render
