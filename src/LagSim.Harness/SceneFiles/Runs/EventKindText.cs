using LagSim.Events;

namespace LagSim.Harness.SceneFiles.Runs;

/// <summary>
/// The word for a kind of event in what the tool writes. Scripts read these words, so they stay even where a kind gets another name.
/// </summary>
internal static class EventKindText
{
    internal static string Of(EventKind kind) => kind == EventKind.HoldKeyframe ? "holdknot" : kind.ToString().ToLowerInvariant();
}
