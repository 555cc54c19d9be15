#include "framework/solve/system_watch.hpp"

#include <stdexcept>

namespace sluice::solve {
namespace {

SystemWatch* the_watch = nullptr;

}  // namespace

SystemWatch::SystemWatch() {
  if (the_watch != nullptr) throw std::logic_error("two watches of linear systems at once");
  the_watch = this;
}

SystemWatch::~SystemWatch() {
  the_watch = nullptr;
}

SystemWatch* SystemWatch::current() {
  return the_watch;
}

}  // namespace sluice::solve
