using LagSim.Rules;
using LagSim.Timelines;

namespace AirHockey;

/// <summary>The negative control: rules with a mistake that is easily made. They keep a count in a field, outside of the state.</summary>
/// <remarks>
/// A late event has a call made again, and takes back what it did to the state; a field it cannot take back. So each peer counts goals as
/// its link has it, and worlds come apart.
/// </remarks>
public sealed class BrokenRules : AirHockeyRules
{
    private int goals;

    public override void OnCrossing(RuleWorld world, in Crossing crossing)
    {
        bool isGoal = crossing is { Entered: true, Sensor: Table.Goals or Table.Goals + 1 };
        world.State<Match>().Spare = isGoal ? ++goals : world.State<Match>().Spare;
        base.OnCrossing(world, crossing);
    }
}
