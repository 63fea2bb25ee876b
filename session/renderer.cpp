#include "dspm/session/renderer.h"

#include <utility>

#include "dspm/session/joint_render.h"

namespace dspm {

std::shared_ptr<const LoadedScene> load_scene(const std::vector<std::string>& files, const Choices& choices,
                                              const Warn& warn) {
  CalledMessages messages(warn);
  Choices without_file = choices;
  without_file.outfile = "image.exr";  // it is never written, and no other kind of file limits the outputs
  return std::make_shared<const LoadedScene>(files, without_file, messages);
}

struct Renderer::Impl : JointRender {
  using JointRender::JointRender;
};

Renderer::Renderer(std::shared_ptr<const LoadedScene> scene, const Warn& warn)
    : impl_(std::make_unique<Impl>(std::move(scene), warn)) {}

Renderer::~Renderer() = default;

const std::vector<std::string>& Renderer::labels() const { return impl_->labels(); }
void Renderer::iterate() { impl_->iterate(); }
int Renderer::iterations() const { return impl_->iterations(); }
int Renderer::wanted() const { return impl_->wanted(); }
const std::vector<std::string>& Renderer::outputs() const { return impl_->outputs(); }
Image Renderer::image(int frame, const std::string& output) const { return impl_->image(frame, output); }
std::vector<Statistics> Renderer::statistics() const { return impl_->statistics(); }
std::string Renderer::state() const { return impl_->state(); }
void Renderer::load_state(std::string_view state) { impl_->load_state(state); }

}  // namespace dspm
