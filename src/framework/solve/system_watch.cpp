#include "framework/solve/system_watch.hpp"

#include <stdexcept>

namespace sluice::solve {
namespace {

LinearSystemObserver* the_watch = nullptr;

}  // namespace

LinearSystemObserver::LinearSystemObserver() {
  if (the_watch != nullptr) throw std::logic_error("two watches of linear systems at once");
  the_watch = this;
}

LinearSystemObserver::~LinearSystemObserver() {
  the_watch = nullptr;
}

LinearSystemObserver* LinearSystemObserver::current() {
  return the_watch;
}

}  // namespace sluice::solve
