namespace LagSim;

/// <summary>Something that the engine can model, whether a scene has it modelled, and why.</summary>
/// <remarks>Immutable, safe on any thread.</remarks>
public sealed class FeatureExplanation
{
    internal FeatureExplanation(string name, bool isModelled, string why)
    {
        Name = name;
        IsModelled = isModelled;
        Why = why;
    }

    /// <summary>The name of the feature.</summary>
    public string Name { get; }

    /// <summary>Whether anything is computed for it.</summary>
    public bool IsModelled { get; }

    /// <summary>Why, in a sentence.</summary>
    public string Why { get; }

    /// <summary>One line: <c>integrator: no. Every path has a closed form.</c></summary>
    public override string ToString() => $"{Name}: {(IsModelled ? "yes" : "no")}. {Why}";
}
