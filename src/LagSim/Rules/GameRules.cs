using System.Diagnostics.CodeAnalysis;
using LagSim.Events;
using LagSim.Scenes;
using LagSim.Timelines;

namespace LagSim.Rules;

/// <summary>The rules of a game: called for what happens in the world, they change their own state and act on bodies.</summary>
/// <remarks>
/// <para>What rules do is part of the world. They are called in the canonical order of events, on every peer alike; a late event has the
/// calls made again that it can have touched, and only those. So their state heals as the motion does, and is the same on all peers, to the
/// bit.</para>
/// <para>A call must follow from what it is given alone: the world's and the bodies' state, what it reads of the world, and the random
/// numbers that it draws. It may keep nothing in fields, and ask no clock, no random numbers but the world's, no function of
/// <see cref="System.Math"/> but the square root, absolute values and comparison, and no order of a hash set or a dictionary.
/// <see cref="HealingMode.SyncTest"/> finds rules that do.</para>
/// <para>Calls are made on the simulation's thread; one object serves many worlds, so it must be immutable. They cost what they do, a copy
/// of the whole state where they change it, and the same again whenever a late event has them made again.</para>
/// <para>An exception out of a call ends the world with a <see cref="SimulationException"/> that names the rules, the call and the instant;
/// in a session it first waits for a late event that removes the cause, as long as one may come. Out of a command it may count as if there
/// had been no command (<see cref="WithFailedCommandsSkipped"/>). A call that does not return is given up
/// after a time by a <see cref="Hosting.RuleWatchdog"/>, if the world has one, as that of a session does.</para>
/// </remarks>
/// <example>
/// A score that counts how often a ball hits a plane, and a countdown:
/// <code>
/// public sealed class Squash : GameRules
/// {
///     public Squash() : base("squash", version: 1) =&gt; WithWorldState&lt;SquashScore&gt;();
///
///     public override bool HearsContact(BodyId first, BodyId second, int surface) =&gt; surface == 0;
///
///     public override void OnStart(RuleWorld world) =&gt; world.SetTimer(1, SimDuration.FromSeconds(60));
///
///     public override void OnContact(RuleWorld world, in RuleContact contact) =&gt; world.State&lt;SquashScore&gt;().Hits++;
///
///     public override void OnTimer(RuleWorld world, int timer) =&gt; world.State&lt;SquashScore&gt;().IsOver = 1;
/// }
/// </code>
/// </example>
[DynamicallyAccessedMembers(DynamicallyAccessedMemberTypes.PublicMethods)] // of those that derive from it: Problem asks for them
public abstract class GameRules : SceneRules
{
    /// <summary>Rules of that name and version. A peer that has not the same ones is refused.</summary>
    /// <param name="name">1 to 64 characters, no control characters and no half of a surrogate pair.</param>
    /// <param name="version">The author's version, raised with every change of what the rules do.</param>
    /// <exception cref="System.ArgumentNullException">There is no name.</exception>
    /// <exception cref="SceneException">It is no name; the sentence says why.</exception>
#pragma warning disable RS0022 // that games derive from this, and so have the base's members, is what it is for
    protected GameRules(string name, int version)
        : base(name, version)
    {
    }
#pragma warning restore RS0022

    /// <summary>Whether <see cref="OnSpawned"/>, <see cref="OnRemoved"/> and <see cref="OnLost"/> are called; default no. Must always give the same.</summary>
    public virtual bool HearsBodies => false;

    /// <summary>The world's state is a value of this type, at first all zero. For the constructor.</summary>
    /// <typeparam name="T">A struct without references and without padding between its fields, of at most
    /// <see cref="SceneRules.MaxWorldBytes"/>.</typeparam>
    /// <exception cref="SceneException">The type is too large, or has padding.</exception>
    protected void WithWorldState<[DynamicallyAccessedMembers(StateType.Fields)] T>()
        where T : unmanaged
    {
        WorldBytes = StateType.SizeOf<T>(MaxWorldBytes, "the world");
        WorldType = typeof(T);
    }

    /// <summary>The state of a body that has one is a value of this type, at first all zero. For the constructor.</summary>
    /// <typeparam name="T">A struct without references and without padding between its fields, of at most
    /// <see cref="SceneRules.MaxBodyBytes"/>.</typeparam>
    /// <exception cref="SceneException">The type is too large, or has padding.</exception>
    protected void WithBodyState<[DynamicallyAccessedMembers(StateType.Fields)] T>()
        where T : unmanaged
    {
        BodyBytes = StateType.SizeOf<T>(MaxBodyBytes, "a body");
        BodyType = typeof(T);
    }

    internal override string? Problem => UnheardRules.Problem(GetType());

    /// <summary>A command that <see cref="OnCommand"/> throws for counts as none: it changes no state and does, sets and tells nothing. For
    /// the constructor.</summary>
    /// <remarks>
    /// <para>So no bytes that a player sends end the world for all. It is part of the scene's hash: a peer whose rules say otherwise is
    /// refused. Every peer is told by <see cref="Hosting.RuleNotices"/> (<see cref="RuleNotice.CommandFailed"/>), the sender too, and the
    /// first of a world is written to <see cref="System.Diagnostics.Trace"/>.</para>
    /// <para>Whatever the rules throw counts, also an exception of LagSim's own types, but for two:
    /// <see cref="System.OutOfMemoryException"/> and <see cref="System.InsufficientExecutionStackException"/>. They say that this machine has
    /// no memory or stack left, and end the world all the same, as does a call that is given up because it does not return: other peers may
    /// fare better.</para>
    /// </remarks>
    protected void WithFailedCommandsSkipped() => SkipsFailedCommands = true;

    /// <summary>The type of the world's state; null for none.</summary>
    internal System.Type? WorldType { get; private set; }

    /// <summary>The type of a body's state; null for none.</summary>
    internal System.Type? BodyType { get; private set; }

    /// <summary>Whether <see cref="OnContact"/> is called for impacts of two, or of one and a surface; default for none.</summary>
    /// <param name="first">The body, of two the one of lesser identity.</param>
    /// <param name="second">The other body; <paramref name="first"/> again where it met a surface.</param>
    /// <param name="surface">Planes by index, static spheres after them, or -1 where two bodies met.</param>
    /// <remarks>Must follow from these three alone. It is asked for every impact of the world.</remarks>
    public virtual bool HearsContact(BodyId first, BodyId second, int surface) => false;

    /// <summary>Whether <see cref="OnCrossing"/> is called when a body enters or leaves a sensor; default for none.</summary>
    /// <param name="body">The body.</param>
    /// <param name="sensor">The index of the sensor in <see cref="Scene.Sensors"/>.</param>
    /// <remarks>Must follow from these two alone.</remarks>
    public virtual bool HearsCrossing(BodyId body, int sensor) => false;

    /// <summary>The scene begins: all its bodies are there, and nothing has happened yet.</summary>
    public virtual void OnStart(RuleWorld world)
    {
    }

    /// <summary>A player tells something (<see cref="PlayerAction.Command"/>). The rules decide whether he may: anybody may send any
    /// command with any bytes.</summary>
    public virtual void OnCommand(RuleWorld world, byte player, GameCommand command)
    {
    }

    /// <summary>
    /// The host says that a player joined, is away, returned or left: the host itself and those who are in already at the very start, anybody
    /// later when the host notices. Only if <see cref="SceneRules.HearsPlayers"/>; a scene refuses rules that override this and not that.
    /// </summary>
    /// <remarks>
    /// All of one player come in order, as <see cref="PlayerEventKind"/> says. A player stamps what it does by its own clock, which may be off by
    /// a little, so its first command may come just before <see cref="PlayerEventKind.Joined"/>. Of two who change places those who go are
    /// heard first.
    /// </remarks>
    public virtual void OnPlayer(RuleWorld world, PlayerEvent player)
    {
    }

    /// <summary>An impact that the rules hear; the bodies already move as they do after it. A scene refuses rules that override this and not
    /// <see cref="HearsContact"/>.</summary>
    public virtual void OnContact(RuleWorld world, in RuleContact contact)
    {
    }

    /// <summary>A body enters or leaves a sensor, as the rules hear it. A scene refuses rules that override this and not
    /// <see cref="HearsCrossing"/>.</summary>
    public virtual void OnCrossing(RuleWorld world, in Crossing crossing)
    {
    }

    /// <summary>A timer is due. It is set no more, unless this sets it again.</summary>
    public virtual void OnTimer(RuleWorld world, int timer)
    {
    }

    /// <summary>A body has appeared, spawned by a player or by these rules. Only if <see cref="HearsBodies"/>; a scene
    /// refuses rules that override this and not that.</summary>
    public virtual void OnSpawned(RuleWorld world, BodyId body)
    {
    }

    /// <summary>A body has disappeared. Its state in the rules (<see cref="RuleWorld.State{T}(BodyId)"/>) and its properties (<see
    /// cref="RuleWorld.SpecOf"/>) can be read here for the last time; it is nowhere any more. Only if
    /// <see cref="HearsBodies"/>; a scene refuses rules that override this and not that.</summary>
    public virtual void OnRemoved(RuleWorld world, BodyId body)
    {
    }

    /// <summary>
    /// A body has left the world by itself, because its motion cannot be followed further, or there is no room for it (<see
    /// cref="LossReason"/>). What can be read of it is as in <see cref="OnRemoved"/>. By default as if it were removed: <see cref="OnRemoved"/>. Only if
    /// <see cref="HearsBodies"/>; a scene refuses rules that override this and not that.
    /// </summary>
    public virtual void OnLost(RuleWorld world, BodyId body, LossReason why) => OnRemoved(world, body);
}
