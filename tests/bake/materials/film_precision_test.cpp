// Films that single precision does not reproduce: which are reported, and that the reported limit is one.
#include "bake/materials/film_precision.h"

#include <cmath>

#include <gtest/gtest.h>

#include "shaders/optics/optics.h"

namespace malus::bake {
namespace {

pack::Material coated(pack::MaterialKind kind, double eta, double k, double filmEta, double thicknessNm) {
  pack::Material m;
  m.name = "coated";
  m.kind = kind;
  m.eta = glm::dvec3(eta);
  m.k = glm::dvec3(k);
  m.coating.eta = glm::dvec3(filmEta);
  m.coating.thicknessNm = thicknessNm;
  return m;
}

TEST(FilmPrecision, OrdinaryCoatingsAreNotReported) {
  using pack::MaterialKind;
  EXPECT_FALSE(insufficientFilmPrecision(coated(MaterialKind::glass, 1.52, 0, 1.38, 100)));
  EXPECT_FALSE(insufficientFilmPrecision(coated(MaterialKind::metal, 1.4, 7.5, 2.4, 500)));
  EXPECT_FALSE(insufficientFilmPrecision(coated(MaterialKind::paint, 1.5, 0, 1.33, 2000)));
  EXPECT_FALSE(insufficientFilmPrecision(coated(MaterialKind::glass, 1.52, 0, 4, 0)));
}

TEST(FilmPrecision, ThickAndHighIndexFilmsAre) {
  using pack::MaterialKind;
  for (const pack::Material& m :
       {coated(MaterialKind::glass, 1.5, 0, 2.5, 1e5), coated(MaterialKind::metal, 0.2, 3.4, 2.0, 1e5),
        coated(MaterialKind::glass, 1.5, 0, 300, 5000), coated(MaterialKind::mirrorGlass, 4, 0, 2, 1e5)}) {
    const auto found = insufficientFilmPrecision(m);
    ASSERT_TRUE(found) << m.coating.eta.x;
    EXPECT_GT(found->difference, kFilmPrecision);
    EXPECT_LT(found->limitWaves, found->waves);
    EXPECT_NEAR(found->waves, m.coating.eta.z * m.coating.thicknessNm / pack::kDefaultWavelengthsNm.z,
                1e-9 * found->waves);
    // Films up to the limit are within the bound at angles that the search did not use.
    pack::Material thin = m;
    thin.coating.thicknessNm *= found->limitWaves / found->waves;
    EXPECT_FALSE(insufficientFilmPrecision(thin));
    for (int i = 0; i < 3000; ++i) {
      const auto c = static_cast<float>((i + 0.37) / 3000);
      const double nf = thin.coating.eta.x, n3 = thin.eta.x, k3 = thin.k.x,
                   phase = 2 * thin.coating.thicknessNm / pack::kDefaultWavelengthsNm.x;
      const auto a = f64::thinFilm(c, 1, nf, phase, n3, k3).reflected;
      const auto b = f32::thinFilm(c, 1, static_cast<float>(nf), static_cast<float>(phase), static_cast<float>(n3),
                                   static_cast<float>(k3))
                         .reflected;
      EXPECT_NEAR(a.rs, static_cast<double>(b.rs), kFilmPrecision) << nf << ' ' << c;
      EXPECT_NEAR(a.rp, static_cast<double>(b.rp), kFilmPrecision) << nf << ' ' << c;
    }
  }
}

}  // namespace
}  // namespace malus::bake
