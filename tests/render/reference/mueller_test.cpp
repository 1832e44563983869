// Products with the reference's matrices against products with the matrices written out.
#include "render/reference/mueller.h"

#include <gtest/gtest.h>

namespace malus::reference {
namespace {

const dvec4 kStokes[] = {{1, 0, 0, 0}, {2, 0.5, -0.25, 1.5}, {0.1, -0.07, 0.03, -0.06}, {0, 1, 0, 0}, {0, 0, 1, 0}};

template <class Matrix>
void expectSameProducts(const Matrix& m) {
  const dmat4 full = matrix(m);
  for (const dvec4& s : kStokes) {
    EXPECT_EQ(m * s, full * s);
    EXPECT_EQ(s * m, s * full);
  }
}

TEST(Mueller, ProductsWithInterfaceMatricesAreThoseOfTheFullMatrix) {
  expectSameProducts(interfaceMatrix(0.3, 0.1, -0.12, 0.05));
  expectSameProducts(interfaceMatrix(0.9, 0.2, 0.4, -0.3));
}

TEST(Mueller, ProductsWithRotationsAreThoseOfTheFullMatrix) {
  const FrameRotation rotation{0.28, 0.96};
  expectSameProducts(rotation);
  EXPECT_EQ(matrix(transposed(rotation)), glm::transpose(matrix(rotation)));
}

TEST(Mueller, InterfaceMatrixIsWrittenOut) {
  const dmat4 m = matrix(interfaceMatrix(0.75, 0.25, 0.3, 0.2));
  EXPECT_EQ(m, rows({0.5, 0.25, 0, 0, 0.25, 0.5, 0, 0, 0, 0, 0.3, -0.2, 0, 0, 0.2, 0.3}));
}

TEST(Mueller, RotationToASurfaceTurnsLightAlongItsAxisIntoS1) {
  const dvec3 d(0, 0, -1);  // the light propagates along +z, whose canonical x is the x axis
  const dvec4 s = toSurface(d, glm::dvec3(0, 1, 0)) * dvec4(1, -1, 0, 0.5);
  EXPECT_EQ(s, dvec4(1, 1, 0, 0.5));
}

}  // namespace
}  // namespace malus::reference
