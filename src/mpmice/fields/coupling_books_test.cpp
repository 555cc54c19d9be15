// The books of the coupling: what is booked anew, what is kept, where it goes.
#include "mpmice/fields/coupling_books.hpp"

#include <gtest/gtest.h>

namespace sluice::mpmice::coupling_books_test {
namespace {

TEST(CouplingBooks, GoToTheSumsOfTheStep) {
  CouplingBooks books;
  books.of_forces(Booked::impulse, 1).add(1);
  books.clear_forces();  // a pass books anew
  books.of_forces(Booked::impulse, 1).add(2);
  books.of_exchange(Booked::impulse, 1).add(0.5);
  books.of_work(Booked::surface_work).add(-3);
  Reduction all;
  books.add_to(all);
  world().reduce(all);
  std::vector<double> sums(12, 1.0);
  books.take(all, {0, 3, 6, 8, 9, 11}, sums);
  const std::vector<double> expected = {1, 3.5, 1, 1, 1, 1, 1, 1, 1, 1, 1, -2};
  EXPECT_EQ(sums, expected);
}

}  // namespace
}  // namespace sluice::mpmice::coupling_books_test
