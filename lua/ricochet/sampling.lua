-- How many samples of a point a wanted standard error takes, in rounds.
local sampling = {}

--- No point stops with fewer units (lattices, struck once or from both sides): of fewer the deviation is small by
--- chance too often, and a stop picks just these: after a pilot of 16, intervals hold the mean in 2 to 3 of 100 cases
--- more where an error asks for 25 units, for a fifth more impacts of the paper's figure (examples/sweeps.md).
sampling.least = 8
-- By how many times the number of units a round may grow: a deviation by a few is rough.
local most_growth = 2
-- What a round takes beyond the units that are needed; a stop asks for none of them.
local spare = 1
-- Pairs are taken from here on: a pilot's gain is rough, and the stricter the choice, the more it picks pairs that
-- scatter little by chance, whose intervals then miss the mean.
local least_gain = 0.75

--- The standard error that is wanted of a mean: an absolute one, or one relative to the mean, whichever is given.
function sampling.wanted(t, mean)
  return t.standard_error or t.relative_error * math.abs(mean)
end

--- How many units a point that has `count` of this deviation is to have after the next round; `count` once it is met,
--- or `most` is.
function sampling.goal(count, sd, wanted, most)
  local needed = (sd / wanted) ^ 2
  if needed <= count and count >= math.min(sampling.least, most) then return count end
  -- A deviation by few may be too large as well: what is far off is approached from below.
  local next = needed > 1.25 * count and math.max(0.8 * needed, count + 2) or needed + spare
  return math.min(math.max(sampling.least, math.ceil(next)), math.ceil(most_growth * count), most)
end

--- By how many times fewer impacts pairs do than single ones for the same standard error: `pairs`, list of the two
--- outcomes of each lattice that has both.
function sampling.gain_of_pairs(pairs)
  local n, single, paired = #pairs, { 0, 0 }, 0
  if n < 2 then return 0 / 0 end
  local mean = { 0, 0 }
  for _, pair in ipairs(pairs) do
    for side = 1, 2 do mean[side] = mean[side] + pair[side] / n end
  end
  for _, pair in ipairs(pairs) do
    local off = 0
    for side = 1, 2 do
      single[side] = single[side] + (pair[side] - mean[side]) ^ 2
      off = off + (pair[side] - mean[side]) / 2
    end
    paired = paired + off ^ 2
  end
  if paired == 0 then return 0 / 0 end
  return (single[1] + single[2]) / 2 / (2 * paired)
end

--- What a point takes next. state: `count` lattices so far, of which the first `both` are struck from both sides;
--- `side`: "one", "tried" (both, to see whether it pays) or "both"; `why` not both. of: sd and units of its outcomes;
--- pairs(): as above. Returns whether more is to run.
function sampling.decide(state, of, wanted, most, pairs)
  if of.units < 2 then return false end  -- more would tell no more
  if state.side == "tried" then
    state.gain = sampling.gain_of_pairs(pairs())
    state.side = state.gain > least_gain and "both" or "one"
    state.why = state.side == "one" and "does not pay" or nil
  end
  local goal = sampling.goal(state.count, of.sd, wanted, most)
  if goal == state.count then return false end
  -- A trial of the other side costs as much as the pilot: where less than a few times that is left, it cannot pay.
  if state.side == "one" and not state.why and (of.sd / wanted) ^ 2 > 3 * state.count then
    state.side, state.both = "tried", state.count
  else
    state.count = goal
    if state.side == "both" then state.both = goal end
  end
  return true
end

return sampling
