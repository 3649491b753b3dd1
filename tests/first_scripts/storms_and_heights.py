from seacrane import cases, ensemble
storms = ensemble(cases.case2, over={"hs": [1.0, 1.5], "seed": range(3)}, keep={"swing": "offlead.max"}, t_end=30)
print(storms)
storms.to_dataframe().to_csv("storms.csv")
# Ensemble of 6 members (2 hs x 3 seed), 0 failed
