using System;

namespace LagSim.Harness.SceneFiles;

/// <summary>The keys that one kind of JSON object may have; the first ones it must have.</summary>
internal sealed class JsonKeys
{
    internal JsonKeys(string[] required, string[] optional)
    {
        Names = [.. required, .. optional];
        RequiredCount = required.Length;
    }

    internal string[] Names { get; }

    internal int RequiredCount { get; }

    internal string Listed => string.Join(", ", Names);

    /// <summary>The place of a key that is one of these.</summary>
    internal int IndexOf(string name) => Array.IndexOf(Names, name);
}
