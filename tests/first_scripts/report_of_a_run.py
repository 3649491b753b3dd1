from seacrane import cases, report, simulate
result = simulate(cases.case2(hs=1.5, tp=8.0), 30)
print(result)
result.plot("roll").savefig("roll.png")
result.to_csv("lift.csv")
print(result.to_dataframe("hook_load", "roll").describe())
report(result).save("report.html")
# Result of 'case2': 301 outputs to 30 s
