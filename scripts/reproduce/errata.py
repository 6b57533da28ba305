"""What is wrong or left open in the paper's text, and the measurement that settles it."""
from measured import plain


def rows(m):
    at = lambda name, digits=2: m.number("mixtures", name).text(digits)
    steady = lambda name, digits=2: m.number("phi0.30-s23", name).text(digits)
    bed = lambda name, digits=2: m.number("phi0.45-s23", name).text(digits)
    kinetic = {"quantity": "kinetic"}
    return [
        ["Π = 2 z f φ/(π d), eqs for Π^L and Π^S", "twice too large: the ½ of P = tr σ/2 is missing",
         f"mean error of Π as printed {at('contacts_error_printed_mean', 0)} %, with 1/(πd) "
         f"{at('contacts_error_mean', 1)} %: the paper's figure 5 belongs to 1/(πd)"],
        ["N_L = n_L z_L/2 are \"contacts with at least one large grain\"",
         "that is N_LL + N_LS/2; with ℓ_L = d_L the errors cancel, so that over ends and with f_n Π^L is P^L",
         f"mean error over ends and with f_n: Π^S {at('ends_error_S_mean')} %, Π^L {at('ends_error_L_mean')} %; "
         f"over contacts and with \\|f\\| {at('contacts_error_S_mean', 1)} and "
         f"{at('contacts_error_L_mean', 1)} %"],
        ["B from z and f (last equation of section V)",
         "right, but with the paper's own mean forces, over contacts, f_S/f_L comes out too large",
         f"B at φ = 1/2 {at('contacts_B', 3)} with the paper's averages, {at('ends_B', 3)} over ends and with "
         f"f_n, {m.fit('mixtures', component='pressure').text(3)} from P^S/P^L itself"],
        ["\"about four orders of magnitude smaller\" (kinetic stress)", "under two",
         f"σ^κ_yy/σ_yy = {steady('Kyy/syy', 4)} on average between 4 and 56 d_S"],
        ["P = ρ g (H₀ − z) (caption of figure 2)", "cosθ is missing; the text has it",
         f"P falls by {steady('P_solid_slope', 3)} ρ g per unit of height; cos 23° = 0.9205"],
        ["V", "with or without voids is not said; with ρ that of grains, only without voids is P the line of "
         "figure 2a, and P^κ that of 3a",
         f"with voids the slope is {steady('P_slope', 3)} ρ g, ν = {steady('nu', 3)}"],
        ["δv", "from which mean velocity is not said; about a layer's mean the shear in the layer counts, "
         "too", f"P^κ at the base {steady('K_solid_prefactor')} ρ g d_S about the profile, "
         f"{steady('K_layer_solid_prefactor')} about the layer's mean: {steady('shear_share')} more"],
        ["axis of figure 4, \"B_κ increases\"", "it shows −B_κ", "B_κ < 0 in "
         f"{sum(row['K'] < 0 for row in m.plain_flows())} of {len(m.plain_flows())} flows here"],
        ["B_κ = −0.373 \"mean\"", "half the sum of the values at φ_L = 1 and φ_S = 1 (−0.4413, −0.3062); at "
         "φ = 1/2 s = 1.4413 gives −0.3615, its mean over φ −0.3655",
         f"here −{plain(abs(m.fit('mixtures', 'B_paper', **kinetic).value), 3)} as half the sum, "
         f"−{plain(abs(m.fit('mixtures', **kinetic).value), 3)} at φ = 1/2, "
         f"{m.fit('mixtures', 'B_direct', **kinetic).text(3)} by direct fit"],
        ["a constant slope s as a constant B", "σ^S/σ^L = s φ_S/φ_L is not Gray & Thornton's law with one B: B "
         "then runs from 1 − s to (1 − s)/s",
         f"for 0.8 to the large grain {m.fit('mixtures', 'B_pure_large', rule='uniform:0.8').text(3)} to "
         f"{m.fit('mixtures', 'B_pure_small', rule='uniform:0.8').text(3)}"],
        ["0.9660 ± 0.003, 0.034 < B < 0.035", "the range is that over φ, the error that of a fit to points "
         "taken as independent",
         f"over runs B = {m.fit('mixtures').text(3)}; unweighted line through the origin "
         f"{m.fit('mixtures', 'B_linear').text(3)}, decided by layers of nearly pure small grains"],
        ["large sensitivity to the mixed contacts as a feature of the flow",
         "geometry: contacts blind to size shift B as much",
         "B_direct less that by size, here and for neutral contacts: "
         + "; ".join(shift(m, rule) for rule in ("uniform:0.8", "uniform:0.6", "half"))],
        ["f/(ρ g (H₀ − y))", "is a length in two dimensions, and lacks cosθ",
         "f/(ρ g cosθ (H − y) d_S) here"],
        ["\"the inequality [f_S < f_L] remains true\" as a property of large grains",
         "forces blind to size are f ∝ d/z at a given pressure",
         f"f_L/f_S over that of blind forces: {bed('f_over_blind')} on average"],
        ["B_κ < 0 \"supports\" segregation by kinetic stress", "with a temperature that falls upwards it pushes "
         "large grains down", "force of the kinetic stress on large grains, 1/1000 of their weight, Φ_L = 0.30: "
         f"{steady('push_kinetic')} (up > 0), of the contact stress {steady('push', 1)}"],
        ["Φ_L \"between 0.06 and 0.90\"; \"width\" 35 d_L; \"segregation rate\"",
         "no result is of 0.90; the length of the cell; its final degree", "–"],
    ]


def shift(m, rule):
    row = m.row("mixtures", rule=rule)
    if row is None:
        return f"{rule} none"
    return f"{rule} {plain(row['minus_size'], 3)} and {plain(row['neutral'], 3)}"
