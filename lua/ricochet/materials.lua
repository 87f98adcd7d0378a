-- Materials whose numbers a reader can look up. In SI. A yield stress stands only where the source has one.
local core = require "ricochet.core"

local material = core.functions.material
local materials = {}

materials.steel = material { E = 205e9, nu = 0.29, density = 7850, yield = 834e6,
  source = "AISI 4340, oil quenched at 800 C, tempered at 650 C, 50 mm round: asm.matweb.com, M434AP" }

materials.aluminium = material { E = 68.9e9, nu = 0.33, density = 2700, yield = 276e6,
  source = "6061-T6: asm.matweb.com, MA6061T6" }

materials.glass = material { E = 72e9, nu = 0.22, density = 2520,
  source = "soda-lime glass: FreeCAD, src/Mod/Material/Resources/Materials/Standard/Glass/Glass-Generic.FCMat" }

materials.alumina = material { E = 416e9, nu = 0.231, density = 3984,
  source = "sintered, 99.5 %, 20 C: srdata.nist.gov/CeramicDataPortal/Pds/Scdaos (NIST SRD 150; R. G. Munro 1997, "
    .. "J. Am. Ceram. Soc. 80, 1919)" }

materials.pmma = material { E = 2.93e9, nu = 0.37, density = 1170, yield = 60.5e6,
  source = "matweb.com, overview of PMMA, as FreeCAD's PMMA-Generic.FCMat has it; nu between 0.35 and 0.40: "
    .. "Brandrup, Immergut, Grulke, Polymer Handbook" }

materials.polycarbonate = material { E = 2.38e9, nu = 0.38, density = 1200, yield = 62.1e6,
  source = "machine grade rod: plastics.tridentplastics.com, item 9118 (tensile modulus 345000 psi, yield 9000 psi)" }

materials.rubber = material { E = 1.5e6, nu = 0.4999, density = 950,
  source = "matweb.com, natural rubber, vulcanized: shear modulus G = 0.5 MPa; E = 3 G and nu next to 1/2, as it "
    .. "hardly changes its volume" }

materials.ice = material { E = 9.20e9, nu = 0.328, density = 917,
  source = "Ih at -16 C: Voigt-Reuss-Hill mean of the elastic constants of P. H. Gammon et al. 1983, J. Glaciology 29, "
    .. "433; density: CRC Handbook of Chemistry and Physics" }

return core.strict(materials, "ricochet.materials")
