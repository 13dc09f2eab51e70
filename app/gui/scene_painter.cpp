#include "app/gui/scene_painter.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <mujoco/mujoco.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "app/language/words.h"
#include "core/error.h"

namespace jnd::app::gui {
namespace {

/// True if the processor draws, which the loop needs, too.
bool renders_in_software() {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view renderer = name == nullptr ? "" : name;
  return renderer.find("llvmpipe") != std::string_view::npos ||
         renderer.find("softpipe") != std::string_view::npos ||
         renderer.find("Software") != std::string_view::npos;
}

/// Restores the state of OpenGL when it is destroyed.
class GlStateGuard {
 public:
  GlStateGuard() {
    glPushAttrib(GL_ALL_ATTRIB_BITS);
    glPushClientAttrib(GL_CLIENT_ALL_ATTRIB_BITS);
  }
  ~GlStateGuard() {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glPopClientAttrib();
    glPopAttrib();
  }
  GlStateGuard(const GlStateGuard&) = delete;
  GlStateGuard& operator=(const GlStateGuard&) = delete;
};

}  // namespace

struct ScenePainter::Renderer {
  explicit Renderer(mjModel_& model) : is_software(renders_in_software()) {
    const GlStateGuard guard;
    model.vis.global.offwidth = kMostSceneWidth_px;
    model.vis.global.offheight = kMostSceneHeight_px;
    model.vis.quality.offsamples = is_software ? 0 : 4;
    if (is_software) {
      model.vis.quality.numslices = 16;
      model.vis.quality.numstacks = 8;
    }
    mjr_defaultContext(&context);
    mjr_makeContext(&model, &context, mjFONTSCALE_50);
    mjr_setBuffer(mjFB_OFFSCREEN, &context);
    if (context.currentBuffer != mjFB_OFFSCREEN) {
      mjr_freeContext(&context);
      throw core::Error(
          tr("3D view: expected OpenGL with framebuffer objects, found none; "
             "install libgl1-mesa-dri or a graphics driver"));
    }
    for (Target& one : targets) {
      glGenTextures(1, &one.texture);
      glGenFramebuffers(1, &one.framebuffer);
    }
  }
  ~Renderer() {
    for (const Target& one : targets) {
      glDeleteFramebuffers(1, &one.framebuffer);
      glDeleteTextures(1, &one.texture);
    }
    mjr_freeContext(&context);
  }
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Draws over the oldest picture. The picture has no alpha, because the window would blend by
  /// it.
  void take_target(int new_width, int new_height) {
    current = (current + 1) % targets.size();
    width = new_width;
    height = new_height;
    Target& target = targets[current];
    if (target.width == width && target.height == height) return;
    target.width = width;
    target.height = height;
    glBindTexture(GL_TEXTURE_2D, target.texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.texture,
                           0);
  }

  void copy(unsigned int from, unsigned int to) const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    glReadBuffer(GL_COLOR_ATTACHMENT0);
    glDrawBuffer(GL_COLOR_ATTACHMENT0);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
  }

  void set_background(mjModel_& model, int id, const SceneColour& colour) const {
    if (id < 0) return;
    mjtByte* rgb = model.tex_rgb + model.tex_adr[id];
    const int num_texels = model.tex_width[id] * model.tex_height[id];
    for (int texel = 0; texel < num_texels; ++texel) {
      for (int i = 0; i < 3; ++i) {
        rgb[3 * texel + i] =
            static_cast<mjtByte>(std::lround(255.0f * colour[static_cast<std::size_t>(i)]));
      }
    }
    mjr_uploadTexture(&model, &context, id);
  }

  /// A picture, and the framebuffer that draws into it.
  struct Target {
    unsigned int texture = 0, framebuffer = 0;
    int width = 0, height = 0;
  };

  const bool is_software;
  mjrContext context;
  // One target is shown by the window, one may still be drawn by it, and one is drawn into.
  std::array<Target, 3> targets;
  std::size_t current = 0;
  int width = 0, height = 0;
  ScenePace pace;
  std::optional<SceneColour> background;
};

ScenePainter::ScenePainter() : renderer_(std::make_unique<Renderer>(scene_.model())) {}

ScenePainter::~ScenePainter() = default;

std::uintptr_t ScenePainter::paint(const SceneRequest& request, double now_s) {
  Renderer& my = *renderer_;
  const SceneLook look = look_of(request, my.is_software);
  if (!my.pace.takes(look, now_s)) return my.targets[my.current].texture;

  const GlStateGuard guard;
  if (my.background != look.colours.ground) {
    my.set_background(scene_.model(), scene_.background_texture(), look.colours.ground);
    my.background = look.colours.ground;
  }
  scene_.show(request.sample, request.surroundings, request.colours, request.camera);
  my.take_target(look.width_px, look.height_px);
  const Renderer::Target& target = my.targets[my.current];
  mjr_setBuffer(mjFB_OFFSCREEN, &my.context);
  mjr_render({0, 0, my.width, my.height}, &scene_.scene(), &my.context);
  if (my.context.offSamples > 0) {
    my.copy(my.context.offFBO, my.context.offFBO_r);
    my.copy(my.context.offFBO_r, target.framebuffer);
  } else {
    my.copy(my.context.offFBO, target.framebuffer);
  }
  // The window's context shows the picture as soon as it gets the texture, so drawing has to be
  // finished.
  glFinish();
  return target.texture;
}

}  // namespace jnd::app::gui
