#include "meniscus/io/vtk_messages.hpp"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace meniscus::io {
namespace {

class MessageCounter : public vtkOutputWindow {
 public:
  static MessageCounter* New() { VTK_STANDARD_NEW_BODY(MessageCounter); }
  void DisplayText(const char* /*text*/) override { ++num_messages; }

  int num_messages = 0;
};

}  // namespace

struct VtkMessages::Impl {
  vtkSmartPointer<vtkOutputWindow> window_before = vtkOutputWindow::GetInstance();
  vtkLogger::Verbosity verbosity_before = vtkLogger::GetCurrentVerbosityCutoff();
  vtkNew<MessageCounter> counter;
};

VtkMessages::VtkMessages() : impl_(std::make_unique<Impl>()) {
  vtkOutputWindow::SetInstance(impl_->counter);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkOutputWindow::SetInstance(impl_->window_before);
  vtkLogger::SetStderrVerbosity(impl_->verbosity_before);
}

bool VtkMessages::any() const { return impl_->counter->num_messages > 0; }

}  // namespace meniscus::io
