#include "integrate/method.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/spelling.hpp"

namespace ricochet {
namespace {

enum class First { drift, kick };

/// A palindrome of drifts and kicks in turn, from its first half and centre as the papers print it.
Method palindrome(std::string name, std::string source, int order, double limit, double usual, First first,
                  const std::vector<double>& half) {
  std::vector<double> whole = half;
  for (std::size_t i = half.size() - 1; i-- > 0;) whole.push_back(half[i]);
  Method m{std::move(name), std::move(source), order, limit, usual, 0, 0, {}};
  // What comes before the first stage is done ahead; the step's last part, which equals it, is joined to that of the
  // next step.
  std::size_t i = 0;
  if (first == First::kick) m.ahead_kick = whole[i++];
  m.ahead_drift = whole[i++];
  for (; i + 1 < whole.size(); i += 2) m.stages.push_back({whole[i], whole[i + 1]});
  if (first == First::kick)
    m.stages.push_back({2 * m.ahead_kick, m.ahead_drift});
  else
    m.stages.back().drift += m.ahead_drift;
  return m;
}

std::vector<Method> make() {
  const double t = 1 / (2 - std::cbrt(2.0));
  std::vector<Method> list;
  list.push_back(
      palindrome("pefrl", "Omelyan, Mryglod & Folk 2002, Comput. Phys. Commun. 146, 188", 4, 2.989, 1.6, First::drift,
                 {0.178617895844809068060904246, 0.712341831062605425480342912, -0.06626458266981848831667094,
                  -0.21234183106260542548034291, 0.775293373650018840511533387}));
  list.push_back(palindrome("forest_ruth", "Forest & Ruth 1990, Physica D 43, 105", 4, 1.573, 0.8, First::drift,
                            {t / 2, t, (1 - t) / 2, 1 - 2 * t}));
  list.push_back(palindrome("verlet", "Verlet 1967, Phys. Rev. 159, 98; the drift-kick-drift form", 2, 2.0, 1.2,
                            First::drift, {0.5, 1}));
  list.push_back({"takahashi_imada",
                  "Takahashi & Imada 1984, J. Phys. Soc. Jpn. 53, 3765; conjugate to order 4: e, v and spin converge "
                  "at order 4, paths only at 2",
                  2,
                  3.463,
                  1.5,
                  0,
                  0.5,
                  {{1, 1, 1.0 / 12}},
                  4});
  list.push_back({"chin_4a",
                  "Chin 1997, Phys. Lett. A 226, 344 (4A); force gradient without a Hessian",
                  4,
                  3.464,
                  1.6,
                  1.0 / 6,
                  0.5,
                  {{2.0 / 3, 0.5, 1.0 / 24}, {1.0 / 3, 0.5}}});
  list.push_back(
      palindrome("mclachlan_sb3a4", "McLachlan 1995, SIAM J. Sci. Comput. 16, 151", 4, 2.967, 1.6, First::drift,
                 {0.188195217768838217868015040, 0.999999999999999999999751742, -0.02152855110217155120136975,
                  -0.49999999999999999999975174, 0.666666666666666666666709423}));
  list.push_back(
      palindrome("blanes_moan_s6", "Blanes & Moan 2002, J. Comput. Appl. Math. 142, 313 (S6)", 4, 3.132, 2, First::kick,
                 {0.079203696431195674197649623, 0.209515106613362052972449986, 0.353172906049774036818665557,
                  -0.14385177317981803796409629, -0.04206508035771952921517158, 0.434336666566455984991646313,
                  0.219376955753499636397712799}));
  list.push_back(palindrome(
      "blanes_moan_srkn6b", "Blanes & Moan 2002, J. Comput. Appl. Math. 142, 313 (SRKN6b)", 4, 3.163, 2, First::kick,
      {0.082984406417404982334898567, 0.245298957184271123448654456, 0.396309801498368061853954643,
       0.604872665711079923626184329, -0.03905630492234843733430565, -0.35017162289535104707483878,
       0.119524194013150786290904884}));
  list.push_back(palindrome(
      "okunbor_skeel_13", "Okunbor & Skeel 1994, J. Comput. Appl. Math. 51, 375 (method 13)", 6, 3.06, 2, First::drift,
      {-1.01308797891717472981490457, 0.000166006926500098942174707, 1.187429573732542707024293321,
       -0.37962421426377360608194690, -0.01833585209646059034438748, 0.689137411851810636740801664,
       0.343994257281092613134998746, 0.380641590970925740797941072}));
  list.push_back(palindrome(
      "blanes_moan_srkn11b", "Blanes & Moan 2002, J. Comput. Appl. Math. 142, 313 (SRKN11b)", 6, 3.139, 2, First::kick,
      {0.041464998518262842282544826, 0.123229775946271150160107599, 0.198128671918066525889007158,
       0.290553797799558291152409937, -0.04000619210415269278089930, -0.12704921262541699725688780,
       0.075253984301580309449752123, -0.24633176106207543571270645, -0.01151138742068775604380885,
       0.357208872795927863335770075, 0.236669924786930771203404043, 0.204777054291470256642613305}));
  list.push_back(palindrome(
      "blanes_moan_srkn14a", "Blanes & Moan 2002, J. Comput. Appl. Math. 142, 313 (SRKN14a)", 6, 3.139, 2, First::drift,
      {0.037859319840611013471773495, 0.091719152624462170850773213, 0.102635633102436603326174992,
       0.183983170005004878998491646, -0.02586788826655834810965088, -0.05653436583288916976693514,
       0.314241403071446406545624072, 0.004914688774711814489438773, -0.13014445951741519949553631,
       0.143761127168371838328147624, 0.106417700369541822245844601, 0.328567693746803460265115365,
       -0.00879424312851017679925680, -0.19641146648646499316503147, 0.207305069056895757630053711}));
  for (const int n : {2, 3, 5, 8}) {
    const double share = 1.0 / n;
    Method m{
        fmt::format("multirate_{}", n),
        fmt::format("impulse r-RESPA (Tuckerman, Berne & Martyna 1992, J. Chem. Phys. 97, 1990) of takahashi_imada: "
                    "the target's springs in one of its steps, the rest in {}; e, v and spin converge at order 4",
                    n),
        2,
        3.463 * n,
        1.5 * n,
        0,
        share / 2,
        std::vector<Stage>(static_cast<std::size_t>(n), Stage{share, share, share * share / 12}),
        4};
    m.slow_limit = 1.8;
    list.push_back(std::move(m));
  }
  // Controls: what a method costs that does not keep the energy.
  list.push_back({"rk4",
                  "Kutta 1901, Z. Math. Phys. 46, 435; not symplectic, a control",
                  4,
                  2.828,
                  1,
                  0,
                  0,
                  {},
                  4,
                  0,
                  {{{}, {0.5}, {0, 0.5}, {0, 0, 1}}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}}});
  list.push_back(
      {"dop853",
       "Dormand & Prince; Hairer, Norsett & Wanner 1993, Solving Ordinary Differential Equations I, II.10; the method "
       "of order 8 at a fixed step; not symplectic, a control",
       8,
       5.96,
       2.4,
       0,
       0,
       {},
       8,
       0,
       {{{},
         {0.05260015195876773},
         {0.0197250569845379, 0.0591751709536137},
         {0.02958758547680685, 0, 0.08876275643042054},
         {0.2413651341592667, 0, -0.8845494793282861, 0.924834003261792},
         {0.037037037037037035, 0, 0, 0.17082860872947386, 0.12546768756682242},
         {0.037109375, 0, 0, 0.17025221101954405, 0.06021653898045596, -0.017578125},
         {0.03709200011850479, 0, 0, 0.17038392571223998, 0.10726203044637328, -0.015319437748624402,
          0.008273789163814023},
         {0.6241109587160757, 0, 0, -3.3608926294469414, -0.868219346841726, 27.59209969944671, 20.154067550477894,
          -43.48988418106996},
         {0.47766253643826434, 0, 0, -2.4881146199716677, -0.590290826836843, 21.230051448181193, 15.279233632882423,
          -33.28821096898486, -0.020331201708508627},
         {-0.9371424300859873, 0, 0, 5.186372428844064, 1.0914373489967295, -8.149787010746927, -18.52006565999696,
          22.739487099350505, 2.4936055526796523, -3.0467644718982196},
         {2.273310147516538, 0, 0, -10.53449546673725, -2.0008720582248625, -17.9589318631188, 27.94888452941996,
          -2.8589982771350235, -8.87285693353063, 12.360567175794303, 0.6433927460157636}},
        {0.054293734116568765, 0, 0, 0, 0, 4.450312892752409, 1.8915178993145003, -5.801203960010585,
         0.3111643669578199, -0.1521609496625161, 0.20136540080403034, 0.04471061572777259}}});
  return list;
}

}  // namespace

int Method::evaluations() const {
  int count = static_cast<int>(tableau.b.size());
  for (const Stage& s : stages) count += s.gradient != 0 ? 2 : 1;
  return count;
}

std::span<const Method> methods() {
  static const std::vector<Method> list = make();
  return list;
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& m : methods()) names.push_back(m.name);
  return names;
}

const Method& method_named(const std::string& name) {
  for (const Method& m : methods())
    if (m.name == name) return m;
  throw FieldError("method", "unknown method '" + name + "'" + did_you_mean(name, method_names()));
}

}  // namespace ricochet
