"""What is wrong or left open in the paper's text, and the measurement that bears on it."""
import statements as paper
import verdicts
from targets import signed


def rows(m):
    at = lambda name, digits=2: m.number("mixtures", name).text(digits)
    steady = lambda name, digits=2: m.number("phi0.30-s23", name).text(digits)
    bed = lambda name, digits=2: m.number("phi0.45-s23", name).text(digits)
    kinetic = {"quantity": "kinetic"}
    return [
        ["Π = 2 z f φ/(π d), and the equations for Π^L and Π^S",
         "twice too large: the ½ of P = tr σ/2 is missing",
         f"mean error of Π as printed {at('contacts_error_printed_mean', 0)} %, with 1/(πd) "
         f"{at('contacts_error_mean', 1)} %: the paper's figure 5 was made with 1/(πd)"],
        ["N_L = n_L z_L/2 as the number of \"contacts with at least one large grain\"",
         "n_L z_L/2 is N_LL + N_LS/2; with ℓ_L = d_L the two errors cancel, so that over contact ends and with "
         "f_n Π^L equals P^L",
         f"mean error over ends and with f_n: Π^S {at('ends_error_S_mean')} %, Π^L {at('ends_error_L_mean')} %; "
         f"over contacts and with \\|f\\| {at('contacts_error_S_mean', 1)} and "
         f"{at('contacts_error_L_mean', 1)} %"],
        ["B from z and f (last equation of section V)",
         "correct, but with the paper's own mean forces, over contacts, f_S/f_L is too large",
         f"B at φ = 1/2: {at('contacts_B', 3)} with the paper's averages, {at('ends_B', 3)} over ends and with "
         f"f_n, {m.of_slope('mixtures', lambda s: 2 * (1 - s) / (1 + s), component='pressure').text(3)} from P^S/P^L itself"],
        ["\"about four orders of magnitude smaller\" (kinetic stress)", "less than two",
         f"σ^κ_yy/σ_yy = {steady('Kyy/syy', 4)} on average between 4 and 56 d_S"],
        ["P = ρ g (H₀ − z) (caption of figure 2)", "cosθ is missing; the text has it",
         f"P falls by {steady('P_solid_slope', 3)} ρ g per unit of height; cos 23° = 0.9205"],
        volume(m),
        ["δv",
         "the mean velocity it refers to is not given; about a layer's mean, the shear inside the layer counts "
         "as fluctuation",
         f"P^κ at the base: {steady('K_solid_prefactor')} ρ g d_S about the profile, "
         f"{steady('K_layer_solid_prefactor')} about the layer's mean. The shear adds {steady('shear_share')} "
         "of P^κ"],
        ["axis of figure 4, \"B_κ increases\"", "it shows −B_κ", "B_κ < 0 in "
         f"{sum(row['K'] < 0 for row in m.plain_flows())} of {len(m.plain_flows())} flows here"],
        ["B_κ = −0.373 \"mean\"",
         "half the sum of the values at φ_L = 1 and φ_S = 1 (−0.4413, −0.3062); s = 1.4413 gives −0.3615 at "
         "φ = 1/2 and −0.3655 as mean over φ",
         f"here {m.fit('mixtures', 'paper_B', **kinetic).text(3)} as half the sum, "
         f"{m.of_slope('mixtures', lambda s: 2 * (1 - s) / (1 + s), **kinetic).text(3)} at φ = 1/2, "
         f"{m.fit('mixtures', **kinetic).text(3)} as a ratio of sums"],
        ["a constant slope s taken as a constant B",
         "σ^S/σ^L = s φ_S/φ_L is not Gray & Thornton's law with a single B: its B runs from 1 − s to (1 − s)/s",
         f"for 0.8 to the large grain: {m.of_slope('mixtures', lambda s: 1 - s, rule='uniform:0.8').text(3)} to "
         f"{m.of_slope('mixtures', lambda s: (1 - s) / s, rule='uniform:0.8').text(3)}"],
        ["0.9660 ± 0.003, 0.034 < B < 0.035",
         "the range is the one over φ; the error is that of a fit which takes all points as independent",
         f"with runs as the independent units B = {m.fit('mixtures', 'paper_B').text(3)} for these six mixtures together, "
         f"{m.range_over_mixtures(3)} by mixture"],
        ["f/(ρ g (H₀ − y))", "has the dimension of a length in 2D, and lacks cosθ",
         "f/(ρ g cosθ (H − y) d_S) is used here"],
        ["\"the inequality [f_S < f_L] remains true\" as a property of large grains",
         "forces that ignore grain size are f ∝ d/z at a given pressure",
         f"f_L/f_S over that of such forces: {bed('f_over_neutral')} on average"],
        ["B_κ < 0 \"supports\" segregation by kinetic stress",
         "where the temperature decreases upward, it pushes large grains down",
         "force on the large grains in 1/1000 of their weight (up > 0), Φ_L = 0.30: kinetic stress "
         f"{steady('push_kinetic')}, contact stress {steady('push', 1)}"],
        ["Φ_L \"between 0.06 and 0.90\"; \"width\" 35 d_L; \"segregation rate\"",
         "no result is for 0.90; 35 d_L is the length of the cell; the \"rate\" is the final degree", "–"],
    ]


def volume(m):
    """Which of figures 2a and 3a each reading of V meets, by the rule of verdicts.py."""
    readings = (("without voids", "_solid"), ("with voids", ""))
    figures = (("the slope of figure 2a", "P{}_slope", 3, paper.FIGURE_2A), ("the prefactor of 3a", "K{}_prefactor", 2, paper.P_KAPPA),
               ("its decay length", "K{}_decay", 1, paper.P_KAPPA_DECAY))
    told, meets = [], {reading: [] for reading, _ in readings}
    for title, name, digits, statement in figures:
        each = []
        for reading, suffix in readings:
            value = m.number("phi0.30-s23", name.format(suffix))
            verdict = verdicts.verdict(value, statement)
            each.append(f"{value.text(digits)} {reading} ({verdict}, {signed(verdicts.difference(value, statement))})")
            if verdict == verdicts.AGREES:
                meets[reading].append(title)
        told.append(f"{title}, {statement.value:g}: {', '.join(each)}")
    met = [f"{reading} it meets {listed(titles)}" for reading, titles in meets.items()]
    return ["V", "**open**: the paper does not say whether V includes the voids. By the tolerances, "
            f"{listed(met)}. If ρ were the density of the bed, both figures would be as without voids",
            "; ".join(told) + ". In brackets: verdict, difference in standard errors"]


def listed(words):
    return " and ".join([", ".join(words[:-1])] * (len(words) > 1) + words[-1:]) or "none of the figures"
