"""The head of a random scene's deck: what decks of fluids, solids and both have in common."""

DECK = """<?xml version="1.0" encoding="UTF-8"?>
<Uintah_specification>
  <Meta><title>random scene {seed}</title></Meta>
  <SimulationComponent type="{component}"/>
  <Time>
    <maxTime>{end}</maxTime> <initTime>0</initTime>
    <delt_min>0</delt_min> <delt_max>{end}</delt_max>
    <timestep_multiplier>{multiplier}</timestep_multiplier>
  </Time>
  <Grid>
    <BoundaryConditions>
{sides}
    </BoundaryConditions>
    <Level>
      <Box label="domain">
        <lower>[0,0,0]</lower> <upper>{upper}</upper>
        <resolution>{cells}</resolution> {extra} <patches>[1,1,1]</patches>
      </Box>
      {periodic}
    </Level>
  </Grid>
  <DataArchiver><filebase>scene.uda</filebase><outputInterval>0</outputInterval></DataArchiver>
{body}
</Uintah_specification>
"""


def deck(component, seed, body, sides, cells, upper, *, extra=None, periodic=None, multiplier=1,
         end="1e9"):
    """`sides`: a <Face> each; `extra`, `periodic`: a number for each direction; None: no tag."""
    def tag(name, value):
        return "" if value is None else f"<{name}>{value}</{name}>"
    return DECK.format(component=component, seed=seed, body=body.strip("\n"),
                       sides="\n".join(sides), cells=cells, upper=upper,
                       extra=tag("extraCells", extra), periodic=tag("periodic", periodic),
                       multiplier=multiplier, end=end)
