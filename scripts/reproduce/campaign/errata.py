"""Errors and gaps in the text of Staron & Phillips (2015), and measurements about them."""
import statements as paper
import verdicts


def rows(m):
    at = lambda name, digits=2: m.number("mixtures", name).text(digits)
    of_08 = lambda f: m.of_slope("mixtures", f, rule="uniform:0.8").text(3)
    pressure = m.of_slope("mixtures", lambda s: 2 * (1 - s) / (1 + s), component="pressure").text(3)
    return [
        ["Π = 2 z f φ/(π d), and the equations for Π^L and Π^S",
         f"twice too large: the ½ of P = tr σ/2 is missing. Its mean error is {at('contacts_error_printed_mean', 0)} %; figure 5 was made with 1/(πd)"],
        ["N_L = n_L z_L/2: \"contacts with at least one large grain\"",
         "n_L z_L/2 is N_LL + N_LS/2; with ℓ_L = d_L the two errors cancel: over ends and with f_n Π^L equals P^L"],
        ["B from z and f (section V)",
         f"correct, but f_S/f_L over contacts is too large. B at φ = 1/2: {at('contacts_B', 3)} with the paper's averages, {at('ends_B', 3)} over ends "
         f"with f_n, {pressure} from P^S/P^L"],
        ["kinetic stress \"about four orders of magnitude smaller\"",
         f"less than two: σ^κ_yy/σ_yy = {m.number('phi0.30-s23', 'Kyy/syy').text(4)} on average"],
        ["P = ρ g (H₀ − z) (caption of figure 2)", "cosθ is missing"],
        volume(m),
        ["δv", "its mean velocity is not given; about a layer's mean, shear counts as fluctuation"],
        ["axis of figure 4, \"B_κ increases\"", f"it shows −B_κ; B_κ < 0 in {sum(row['K'] < 0 for row in m.plain_flows())} of {len(m.plain_flows())} flows"],
        ["B_κ = −0.373 \"mean\"", "half the sum of the end values (−0.4413, −0.3062); s = 1.4413 gives −0.3615 at φ = 1/2, −0.3655 as mean over φ"],
        ["a constant slope s taken as a constant B",
         f"its B runs from 1 − s to (1 − s)/s: for p = 0.8 from {of_08(lambda s: 1 - s)} to {of_08(lambda s: (1 - s) / s)}"],
        ["0.9660 ± 0.003, 0.034 < B < 0.035", "the range is over φ; the error takes all points as independent"],
        ["f/(ρ g (H₀ − y))", "a length in 2D, and lacks cosθ; here f/(ρ g cosθ (H − y) d_S)"],
        ["f_S < f_L \"remains true\" as a property of large grains", "forces that ignore size have f ∝ d/z at a given pressure"],
        ["B_κ < 0 \"supports\" segregation by kinetic stress", "where temperature decreases upward, it pushes large grains down ([by flow](#the-flows))"],
        ["Φ_L to 0.90; \"width\" 35 d_L; \"segregation rate\"", "no result is for 0.90; 35 d_L is a length; the \"rate\" is the final degree"],
    ]


def volume(m):
    """Row on V: the numbers of figures 2a and 3a that agree (verdicts.py) with each interpretation of the volume V."""
    figures = (("the slope of 2a", "P{}_slope", paper.FIGURE_2A), ("the prefactor of 3a", "K{}_prefactor", paper.P_KAPPA),
               ("its decay length", "K{}_decay", paper.P_KAPPA_DECAY))
    met = []
    for reading, suffix in (("without voids", "_solid"), ("with voids", "")):
        titles = [title for title, name, statement in figures
                  if verdicts.verdict(m.number("phi0.30-s23", name.format(suffix)), statement) == verdicts.AGREES]
        met.append(f"{reading} it meets {listed(titles)}")
    return ["V", f"**open**: {'; '.join(met)}. If ρ were the density of the bed, both figures would be as without voids"]


def listed(words):
    return " and ".join([", ".join(words[:-1])] * (len(words) > 1) + words[-1:]) or "none"
