from seacrane import cases, ensemble
storms = ensemble(cases.case2(), over={"seed": range(20)}, keep={"hook": "hook_load.max"}, t_end=600)
# 
