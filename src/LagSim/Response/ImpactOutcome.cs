
namespace LagSim.Response;

/// <summary>The outcome of an impact on an island.</summary>
internal enum ImpactOutcome
{
    /// <summary>It is solved, and the segments after it are open.</summary>
    Done,

    /// <summary>Nothing was done: a body that takes part is ahead, and has to be rewound first.</summary>
    NeedsRewind,

    /// <summary>Nothing was done: what a hand strikes can give way, or has room, so that it is an impact like others.</summary>
    GivesWay,
}
