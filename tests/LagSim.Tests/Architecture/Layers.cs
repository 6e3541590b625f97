namespace LagSim.Tests.Architecture;

/// <summary>The layers of the source, from the lowest to the highest. Read it from top to bottom: a folder knows folders above its own line, and no other.</summary>
/// <remarks>
/// A line is one layer. Folders of one line do not know each other. A name in parentheses is no folder, but the types of a folder that lie lower than it does;
/// they are in <see cref="Placed"/>, each with the reason why it is not moved.
/// </remarks>
internal static class Layers
{
    internal const string EngineWords = "LagSim (words)";
    internal const string SessionWords = "LagSim.Net/Sessions (words)";
    internal const string AccuracyWords = "LagSim.Harness/Experiments/Accuracy (words)";

    internal static readonly string[][] Order =
    [
        // The engine.
        ["LagSim/Time"],
        ["LagSim/Scenes"],
        [EngineWords],
        ["LagSim/Motion", "LagSim/Events"],
        ["LagSim/Timelines"],
        ["LagSim/BroadPhase", "LagSim/Contacts", "LagSim/Rules"],
        ["LagSim/Collisions", "LagSim/Trajectories"],
        ["LagSim/Rollback"],
        ["LagSim/Islands"],
        ["LagSim/Response"],
        ["LagSim/Handlers"],
        ["LagSim"],
        ["LagSim/Hosting"],

        // Peers.
        ["LagSim.Net/Protection"],
        ["LagSim.Net/Carriers", "LagSim.Net/Clocks", "LagSim.Net/Display", "LagSim.Net/Strategies", "LagSim.Net/Wire"],
        [SessionWords],
        ["LagSim.Net/Sessions/Links"],
        ["LagSim.Net/Sessions/Core"],
        ["LagSim.Net/Sessions/Hosts", "LagSim.Net/Sessions/Clients"],
        ["LagSim.Net/Sessions"],
        ["LagSim.Net/Recordings", "LagSim.Net.LiteNetLib", "LagSim.Net.Secure", "LagSim.Net.WebSockets"],

        // Tests for games.
        ["LagSim.Testing/Links", "LagSim.Testing/Text"],
        ["LagSim.Testing/Invariant"],
        ["LagSim.Testing/Running"],
        ["LagSim.Testing"],

        // What the tool does.
        ["LagSim.Harness/Reports/Charts"],
        ["LagSim.Harness/Reports"],
        ["LagSim.Harness/SceneFiles", "LagSim.Harness/SceneFiles/Runs", "LagSim.Harness/Verification"],
        [
            "LagSim.Harness/Relays", "LagSim.Harness/Verification/References", "LagSim.Harness/Verification/Check",
            "LagSim.Harness/Experiments/Metrics", "LagSim.Harness/Experiments/Hands", AccuracyWords,
        ],
        [
            "LagSim.Harness/Verification/Hard", "LagSim.Harness/Verification/Stalls", "LagSim.Harness/Verification/Worlds",
            "LagSim.Harness/Experiments/Peers", "LagSim.Harness/Experiments/Sweep", "LagSim.Harness/Experiments/Accuracy/Engines",
        ],
        ["LagSim.Harness/Experiments/Accuracy/Engines/Packages"],
        ["LagSim.Harness/Experiments/Accuracy"],
        [
            "LagSim.Harness/Verification/Fuzz", "LagSim.Harness/Verification/Harm",
            "LagSim.Harness/Experiments/Compare", "LagSim.Harness/Experiments/Drop", "LagSim.Harness/Experiments/Hold",
        ],

        // The page.
        ["LagSim.Play"],
        ["LagSim.Play.Browser"],

        // The tool.
        ["LagSim.Cli/Output"],
        ["LagSim.Cli/Web"],
        ["LagSim.Cli/Commands"],
        ["LagSim.Cli"],
    ];

    private const string ForUsers = "public: users find it in the namespace of what they call, though lower folders use it";

    internal static readonly PlacedType[] Placed =
    [
        new("LagSim.BodyState", EngineWords, ForUsers),
        new("LagSim.InstantException", EngineWords, ForUsers),
        new("LagSim.HealingMode", EngineWords, ForUsers),
        new("LagSim.HealReport", EngineWords, ForUsers),
        new("LagSim.Hold", EngineWords, ForUsers),
        new("LagSim.SimulationException", EngineWords, ForUsers),
        new("LagSim.TimelinesFullException", EngineWords, ForUsers),

        new("LagSim.Net.Sessions.CommittedState", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.Divergence", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.DivergenceFinding", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.KeyRefusal", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.LinkTraffic", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.LogEntry", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.PlayerBudget", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.PlayerCost", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.PlayerExpulsion", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.PlayerPass", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.RosterChange", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.RosterChangeKind", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.RosterMember", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.SessionCounters", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.SessionEnd", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.SessionOptions", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.HostOptions", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.ClientOptions", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.SessionState", SessionWords, ForUsers),
        new("LagSim.Net.Sessions.Hosts.JoinLimits", SessionWords, "an option of a session that only tests set"),

        new("LagSim.Testing.FirstDifference", "LagSim.Testing/Invariant", ForUsers),
        new("LagSim.Testing.PlayerResult", "LagSim.Testing/Running", ForUsers),
        new("LagSim.Testing.SessionTestException", "LagSim.Testing/Running", ForUsers),
        new("LagSim.Testing.SessionTestResult", "LagSim.Testing/Running", ForUsers),
        new("LagSim.Testing.TestPlayer", "LagSim.Testing/Running", ForUsers),
        new("LagSim.Testing.WorldsDifferException", "LagSim.Testing/Running", ForUsers),

        new("LagSim.Harness.Experiments.Accuracy.ContactWork", AccuracyWords, "a scene that engines build in their own way"),
        new("LagSim.Harness.Experiments.Accuracy.RandomHeapWork", AccuracyWords, "a scene that engines build in their own way"),
        new("LagSim.Harness.Experiments.Accuracy.DriftWatch", AccuracyWords, "what such a scene is watched with"),
        new("LagSim.Harness.Experiments.Accuracy.EnergyGainWatch", AccuracyWords, "what such a scene is watched with"),
        new("LagSim.Harness.Experiments.Accuracy.OverlapWatch", AccuracyWords, "what such a scene is watched with"),
        new("LagSim.Harness.Experiments.Accuracy.Pit", AccuracyWords, "part of such a scene"),
        new("LagSim.Harness.Experiments.Accuracy.IWorkMethod", AccuracyWords, "what an engine implements to be measured"),
        new("LagSim.Harness.Experiments.Accuracy.IWorkRun", AccuracyWords, "what an engine implements to be measured"),
        new("LagSim.Harness.Experiments.Accuracy.WorkScene", AccuracyWords, "what an engine is given"),
        new("LagSim.Harness.Experiments.Accuracy.WorkSetting", AccuracyWords, "what an engine is given"),
    ];
}
