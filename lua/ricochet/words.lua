-- What people call the columns of rows and series: words, and a symbol where one is usual (as gnuplot typesets them).
local words = {}

local table_of = {
  -- rows: the paper's numbers, those along the contact's normal
  e = { "normal restitution", "e" }, beta = { "tangential restitution", "β" }, mu = { "impulse ratio", "μ" },
  psi1 = { "incidence", "Ψ_1" }, psi2 = { "rebound", "Ψ_2" },
  normal_x = { "contact's normal along x" }, normal_y = { "contact's normal along y" },
  e_n = { "restitution along the contact's normal", "e_n" },
  beta_n = { "restitution across the contact's normal", "β_n" },
  mu_n = { "impulse ratio with the contact's normal", "μ_n" },
  e_first = { "restitution at the first parting", "e" }, mu_first = { "impulse ratio at the first parting", "μ" },
  time_first = { "end of the first touch" },
  -- motion
  vn = { "normal velocity", "v_n" }, vt = { "tangential velocity", "v_t" }, omega = { "spin", "ω" },
  target_vn = { "normal velocity of the target" }, target_vt = { "tangential velocity of the target" },
  target_omega = { "spin of the target" }, impulse_n = { "normal impulse", "J_n" },
  impulse_t = { "tangential impulse", "J_t" }, last_vn = { "normal velocity at the end" },
  last_vt = { "tangential velocity at the end" }, last_omega = { "spin at the end" },
  last_energy = { "energy at the end" },
  -- contact
  contact_time = { "contact time", "t_c" }, contact_time_energy = { "contact time by energy" },
  touches = { "number of touches" }, indentation = { "indentation" }, overlap = { "overlap" },
  penetration = { "penetration of nodes" }, contact_length = { "length of the contact" },
  centre_offset = { "centre behind the contact's end" }, tan_alpha = { "slope of the contact", "tan α" },
  e_alpha = { "restitution along the turned normal", "e_α" },
  -- energy
  before_projectile_translation = { "translation of the projectile before" },
  before_projectile_rotation = { "rotation of the projectile before" },
  before_projectile_vibration = { "vibration of the projectile before" },
  before_target_translation = { "translation of the target before" },
  before_target_rotation = { "rotation of the target before" },
  before_target_vibration = { "vibration of the target before" }, before_total = { "energy before" },
  after_projectile_translation = { "translation of the projectile after" },
  after_projectile_rotation = { "rotation of the projectile after" },
  after_projectile_vibration = { "vibration of the projectile after" },
  after_target_translation = { "translation of the target after" },
  after_target_rotation = { "rotation of the target after" },
  after_target_vibration = { "vibration of the target after" }, after_contact = { "energy of the contact after" },
  -- run
  energy_closure = { "closure of the energy" }, energy_drift = { "greatest drift of the energy" },
  inverted = { "share of area turned over" }, inversion_time = { "when area turned over" }, folded = { "folded" },
  inertia = { "inertia", "I/MR^2" }, inertia_target = { "inertia of the target" },
  xi = { "inverse range of the repulsion", "ξ" }, V0 = { "energy of the repulsion", "V_0" },
  certified = { "certified" }, time = { "time", "t" }, step = { "time step", "Δt" },
  theta = { "step by highest frequency", "θ" }, theta_most = { "greatest step by highest frequency", "θ" },
  steps = { "number of steps" }, momentum_residual = { "residual of momentum" },
  error_step = { "error from the step" }, error_contact = { "error from the soft contact" },
  error_contact_time = { "excess of contact time" }, over_yield = { "over the yield stress" },
  plastic_strain_most = { "greatest plastic strain" }, dent = { "depth of the dent" },
  dent_target = { "depth of the dent in the target" },
  -- series
  x = { "place along the surface", "x" }, height = { "height", "y" }, angle = { "angle turned" },
  force_n = { "normal force", "F_n" }, force_t = { "tangential force", "F_t" }, vibration = { "energy of vibration" },
  projectile_translation = { "translation of the projectile" }, projectile_rotation = { "rotation of the projectile" },
  projectile_vibration = { "vibration of the projectile" }, target_translation = { "translation of the target" },
  target_rotation = { "rotation of the target" }, target_vibration = { "vibration of the target" },
  contact_energy = { "energy of the contact" }, effects_energy = { "energy of effects" },
  total_energy = { "all energy" },
}
-- Where a sweep's own values have the name of a column: what it asked for, and what came of it.
table_of.over_psi1, table_of.outcome_psi1 = table_of.psi1, { "incidence of the contact", "Ψ_1" }
table_of.over_step, table_of.outcome_step = { "time step asked for", "Δt" }, { "time step taken", "Δt" }
table_of.over_seed, table_of.outcome_seed = { "seed asked for" }, { "seed of the projectile" }
for _, of in ipairs { "", "target_" } do
  local body = of == "" and "" or " in the target"
  table_of[of .. "pressure_max"] = { "greatest pressure" .. body }
  table_of[of .. "von_mises_max"] = { "greatest von Mises stress" .. body }
  table_of[of .. "von_mises_depth"] = { "depth of the greatest stress" .. body }
end

-- Of an effect: its name stands in the column's.
local endings = { _energy = "energy of %s", _springs = "springs changed by %s", _elements = "elements changed by %s" }

local function words_of(column)
  if table_of[column] then return table_of[column] end
  for ending, text in pairs(endings) do
    local effect = column:sub(-#ending) == ending and column:sub(1, -#ending - 1)
    if effect then return { text:format(effect:gsub("_", " ")) } end
  end
end

--- True if the column has words of its own.
function words.known(column) return words_of(column) ~= nil end

--- "contact time t_c"; a column of the script's own is called as the script calls it.
function words.label(column)
  local entry = words_of(column)
  if not entry then return (column:gsub("_", " ")) end
  return entry[1] .. (entry[2] and " " .. entry[2] or "")
end

--- "t_c", or the name.
function words.symbol(column)
  local entry = table_of[column]
  return entry and entry[2] or column
end

return words
