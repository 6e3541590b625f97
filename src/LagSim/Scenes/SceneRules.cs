using System;

namespace LagSim.Scenes;

/// <summary>The rules of a game as a scene has them: their name, their author's version, and how large their state is.</summary>
/// <remarks>Derive from <see cref="Rules.GameRules"/>. Immutable once a scene has them; used by many worlds at a time.</remarks>
public abstract class SceneRules
{
    /// <summary>The number that stands for the rules where a peer's does: 255. Bodies that they spawn have identities (255, n, 0), n from
    /// 1; no peer of a session has it.</summary>
    public const byte Peer = 255;

    /// <summary>The most bytes of state of the whole world: 16,384.</summary>
    public const int MaxWorldBytes = 16_384;

    /// <summary>The most bytes of state of a body: 256.</summary>
    public const int MaxBodyBytes = 256;

    private protected SceneRules(string name, int version)
    {
        Name = name ?? throw new ArgumentNullException(nameof(name));
        Version = version;
        if (PartName.Problem(name) is string problem)
        {
            throw new SceneException($"'{PartName.Shown(name)}' is no name for rules: {problem}.");
        }
    }

    /// <summary>The name, 1 to 64 characters; it is part of the scene's hash.</summary>
    public string Name { get; }

    /// <summary>The author's version, raised with every change of what the rules do; it is part of the scene's hash.</summary>
    public int Version { get; }

    /// <summary>The size of the world's state in bytes; 0, the default, for none. Part of the scene's hash.</summary>
    public int WorldBytes { get; private protected set; }

    /// <summary>The size of the state of a body that has one, in bytes; 0, the default, for none. Part of the scene's hash.</summary>
    public int BodyBytes { get; private protected set; }

    /// <summary>Whether they hear of players (<see cref="Rules.GameRules.OnPlayer"/>); default no. Must always give the same.</summary>
    public virtual bool HearsPlayers => false;

    /// <summary>What makes them no rules for a scene, as the rest of a sentence about them; null if nothing does.</summary>
    internal abstract string? Problem { get; }

    /// <summary>Whether a command that the rules fail in counts as none; otherwise, the default, it ends the world. Part of the scene's hash,
    /// so that all peers do the same.</summary>
    public bool SkipsFailedCommands { get; private protected set; }

    /// <summary>The name and the version, for messages.</summary>
    public override string ToString() => FormattableString.Invariant($"{Name} {Version}");
}
