namespace LagSim.Scenes;

/// <summary>The owner of a wrong value, in words: made only if there is an error.</summary>
internal readonly struct BodyText
{
    private readonly string name;

    internal BodyText(string name) => this.name = name;

    public override string ToString() => $"body '{name}'";
}
