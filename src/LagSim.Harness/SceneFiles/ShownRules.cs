using System.Collections.Generic;
using LagSim.Rules;
using LagSim.Time;

namespace LagSim.Harness.SceneFiles;

/// <summary>Rules whose state the tool can show: numbers by name.</summary>
public abstract class ShownRules : GameRules
{
    /// <summary>Rules of that name and version.</summary>
    protected ShownRules(string name, int version)
        : base(name, version)
    {
    }

    /// <summary>The state of a world with these rules, at an instant that can be read: names in lower case with underscores, and units at
    /// their ends.</summary>
    public abstract IReadOnlyList<KeyValuePair<string, double>> Show(Simulation world, SimTime time);
}
