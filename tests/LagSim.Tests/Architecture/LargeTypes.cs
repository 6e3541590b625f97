namespace LagSim.Tests.Architecture;

/// <summary>The types that have more than 400 lines or 15 fields, each with the reason why it is not split, or not yet.</summary>
internal static class LargeTypes
{
    internal static readonly LargeType[] All =
    [
        // The engine.
        new("LagSim.Contacts.SolverContact", "a row of the solver, kept flat: what is read together lies together"),
        new("LagSim.Engine", "puts the parts together, a field for each part; it has next to no code of its own"),

        new("LagSim.Hosting.LiveWorld", "a world with all that reports of it, and how late it was"),
        new("LagSim.Rules.RuleWorld", "the public face of the world to rules: a documented member for each thing that a call may ask or do; next to no code"),
        new("LagSim.Scenes.Scene", "a field for each part that a scene has"),
        new("LagSim.Scenes.SceneBuilder", "a documented method for each part that a scene may have"),
        new("LagSim.Simulation", "the public face: a documented member for each thing that can be asked of a world; next to no code"),
        new("LagSim.Timelines.TimelineStore", "the arrays of one store of segments, and who is notified of them"),

        // Peers.
        new("LagSim.Net.Sessions.Core.SessionParts", "puts the parts together, a field for each part; it has no code of its own"),
        new("LagSim.Net.Sessions.SessionCounters", "a number for each thing that is counted"),
        new("LagSim.Net.Sessions.SessionOptions", "a field for each option that hosts and clients both have"),
        new("LagSim.Net.Wire.UpdateDatagram", "a field for each that the datagram carries"),

        // Tests for games.
        new("LagSim.Testing.Links.BulkTransfer", "the state of one sender of a stream, most of it the numbers of its congestion window"),
        new("LagSim.Testing.Links.LinkModel", "one direction of a link: a stream of random numbers for each thing that can go wrong there, and where it stands"),

        // What the tool does.
        new("LagSim.Harness.Experiments.Compare.CompareRun", "one run from start to end: its set-up, its players and what it measures"),
        new("LagSim.Harness.Experiments.Drop.DropRun", "one run from start to end: its set-up, its players and what it measures"),
        new("LagSim.Harness.Experiments.Hold.HoldRun", "one run from start to end: its set-up, its players and what it measures"),
        new("LagSim.Harness.Experiments.Sweep.SweepOutcome", "a result record, a field for each column"),
        new("LagSim.Harness.Relays.RelayCore", "what a relay is set to, its clients, and what it counts"),
        new("LagSim.Harness.Verification.Check.CheckOutcome", "a result record, a field for each figure"),
        new("LagSim.Harness.Verification.Check.SceneFeatures", "a result record, a field for each feature"),
        new("LagSim.Harness.Verification.Check.RoomScene", "draws a scene: a field for each trait that all its bodies share"),
        new("LagSim.Harness.Verification.Stalls.StallClient", "one client of a run, with all that is measured of it"),
        new("LagSim.Harness.Verification.Stalls.StallProcessRun", "one run from start to end: its set-up, its processes and what it measures"),
        new("LagSim.Harness.Verification.Stalls.StallRun", "one run from start to end: its set-up, its players and what it measures"),
    ];
}
