using System;

namespace LagSim.Harness.SceneFiles;

/// <summary>The keys of one kind of JSON object. The first ones are required.</summary>
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

    /// <summary>Returns the index of a key.</summary>
    internal int IndexOf(string name) => Array.IndexOf(Names, name);
}
