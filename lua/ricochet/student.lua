-- Student's t: how far the mean of a few numbers strays from the true one, over its standard error.
local student = {}

-- The probability that |t| stays below tan(angle) sqrt(n), for n degrees of freedom: a finite sum, with its complement
-- at 0. [Abramowitz & Stegun 1964, 26.7.3 and 26.7.4]
local function within_angle(angle, n)
  local sine, cosine = math.sin(angle), math.cos(angle)
  local term, sum = 1, 0
  if n % 2 == 1 then
    term = cosine
    for k = 3, n, 2 do
      sum = sum + term
      term = term * cosine * cosine * (k - 1) / k
    end
    return 2 / math.pi * (angle + sine * sum)
  end
  for k = 2, n, 2 do
    sum = sum + term
    term = term * cosine * cosine * (k - 1) / k
  end
  return sine * sum
end

--- The probability that |t| is at most `t` with n degrees of freedom, a whole number from 1.
function student.within(t, n) return within_angle(math.atan(t / math.sqrt(n)), n) end

--- The `t` within which |t| stays with the probability `share`, 0.95 unless given.
function student.quantile(n, share)
  share = share or 0.95
  local low, high = 0, math.pi / 2
  while true do
    local middle = (low + high) / 2
    if middle <= low or middle >= high then return math.sqrt(n) * math.tan(middle) end
    if within_angle(middle, n) < share then low = middle else high = middle end
  end
end

--- Whether a mean is told apart from 0, falsely in one of twenty cases: by its standard error, which n degrees of
--- freedom measured. Of none nothing is known.
function student.is_seen(mean, se, n)
  return n >= 1 and math.abs(mean) > student.quantile(n) * se
end

return student
