"""The numbers of grseg-fit, whose table has a row for each, as one dictionary per rule, flow and pair."""
import math


def by_rule(rows):
    """ROWS as read, cells text or numbers. Of each rule: rule, flow, pair, and for every quantity NAME, NAME_low, NAME_high;
    B is over what was asked for, B_OVER (B_windows, B_equal_flows ...) over each population that is known. Numbers
    of no rule (p_zero, dB_dp, Phi_L ...) belong to all. degrees_of_freedom are those of B; nan where a number is missing."""
    found, common = {}, {}
    for row in rows:
        flow = row["flow"], row["pair"]
        own = common.setdefault(flow, Numbers()) if row["rule"] == "-" else \
            found.setdefault((row["rule"], *flow), Numbers(rule=row["rule"], flow=row["flow"], pair=row["pair"]))
        three = {end: float(row[name]) for end, name in (("", "value"), ("_low", "low"), ("_high", "high"))}
        name = row["quantity"].split("[")[0]
        if name == "B":
            own.update({f"B_{row['over'].replace('-', '_')}{end}": value for end, value in three.items()})
            if "B" not in own:
                own["degrees_of_freedom"] = float(row["degrees_of_freedom"])
        for end, value in three.items():
            own.setdefault(name + end, value)
    for (rule, *flow), own in found.items():
        own.update(common.get(tuple(flow), {}))
    return list(found.values())


class Numbers(dict):
    def __missing__(self, name):
        return math.nan
