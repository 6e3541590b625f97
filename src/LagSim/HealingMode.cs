namespace LagSim;

/// <summary>
/// How a <see cref="Simulation"/> brings in an event that lies before its time. All give the same bits; they differ in cost.
/// </summary>
public enum HealingMode
{
    /// <summary>
    /// Rewrites only the timelines that the late event can have touched. The cost follows from that, not from the size of the world.
    /// </summary>
    CausalCone,

    /// <summary>Rewrites everything since the event's time, for all bodies.</summary>
    FullRollback,

    /// <summary>
    /// As <see cref="CausalCone"/>, and a second world is kept that is fully rolled back; after every heal all timelines are compared bit
    /// by bit. The first difference ends the simulation with a <see cref="SimulationException"/> that names it. To test one's own scene;
    /// costs more than twice as much.
    /// </summary>
    SyncTest,
}
