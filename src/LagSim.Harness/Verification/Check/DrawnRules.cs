using System;
using LagSim.Events;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Harness.Verification.Check;

/// <summary>Rules drawn by a seed: they hear of some contacts, of commands, timers and bodies, read bodies and regions, draw random
/// numbers, and act on bodies; everything that they come to know goes into a digest in their state. Where a session asks for it they hear of
/// its players too.</summary>
internal sealed class DrawnRules : GameRules
{
    /// <summary>The most bodies that they spawn.</summary>
    internal const int MaxSpawns = 6;

    private const int Timers = 4;

    private readonly ulong seed;
    private readonly int contacts; // of how many pairs one is heard
    private readonly int acts; // of how many calls for a contact one acts
    private readonly bool hearsBodies;

    /// <summary>The rules of a seed.</summary>
    /// <param name="seed">The seed.</param>
    /// <param name="hearsPlayers">Whether they hear of players. It changes nothing else that they do.</param>
    internal DrawnRules(ulong seed, bool hearsPlayers = false)
        : base("drawn", unchecked((int)seed))
    {
        this.seed = seed;
        HearsPlayers = hearsPlayers;
        contacts = 1 + (int)(Mix(seed, 1) % 3);
        acts = 2 + (int)(Mix(seed, 2) % 5);
        hearsBodies = Mix(seed, 3) % 2 == 0;
        WithWorldState<Total>();
        if (Mix(seed, 4) % 4 != 0)
        {
            WithBodyState<OfBody>();
        }

        if (Mix(seed, 5) % 2 == 0)
        {
            WithFailedCommandsSkipped();
        }
    }

    /// <inheritdoc/>
    public override bool HearsBodies => hearsBodies;

    /// <inheritdoc/>
    public override bool HearsPlayers { get; }

    /// <inheritdoc/>
    public override bool HearsContact(BodyId first, BodyId second, int surface) =>
        Mix(Mix(first.Packed, second.Packed), (ulong)(surface + 2)) % (ulong)contacts == 0;

    /// <inheritdoc/>
    public override void OnStart(RuleWorld world)
    {
        for (int n = 0; n < Timers; n++)
        {
            world.SetTimer(n, SimDuration.FromMilliseconds(20 + (int)(Mix(seed, (ulong)(10 + n)) % 300)));
        }
    }

    /// <inheritdoc/>
    public override void OnCommand(RuleWorld world, byte player, GameCommand command)
    {
        Note(world, (ulong)command.Number);
        Note(world, (ulong)command.Length);
        Act(world, Any(world));
        if (SkipsFailedCommands && command.Length % 3 == 1)
        {
            throw new InvalidOperationException("A command of such a length fails.");
        }
    }

    /// <inheritdoc/>
    /// <remarks>By the kind it is a push, a ball, or points, of a size that hangs on the player's number, its identity, or how much was heard before.</remarks>
    public override void OnPlayer(RuleWorld world, PlayerEvent player)
    {
        Note(world, ((ulong)player.Kind << 16) | ((ulong)player.Role << 8) | player.Number);
        Note(world, player.Identity);
        foreach (char letter in player.Name)
        {
            Note(world, letter);
        }

        ref Total total = ref world.State<Total>();
        int bodies = world.Scene.Bodies.Count;
        BodyId body = bodies == 0 ? default : BodyId.OfScene((int)(player.Identity % (ulong)bodies));
        Vector3D some = new(total.Calls % 4, player.Number % 3, (player.Identity % 5) - 2.0);
        switch ((Mix(seed, 6) + (ulong)player.Kind) % 4)
        {
            case 0 when bodies > 0:
                world.Impulse(body, some * world.SpecOf(body).Mass);
                break;
            case 1 when bodies > 0 && total.Spawns < MaxSpawns:
                total.Spawns++;
                SceneBody like = world.Scene.Bodies[body.Index];
                total.Last = world.Spawn(like.Spec, like.Position, some, whenOccupied: (WhenOccupied)(player.Number % 3)).Packed;
                break;
            case 2:
                total.Score += (int)(total.Calls % 4) + player.Number;
                break;
            default:
                Act(world, body);
                break;
        }
    }

    /// <inheritdoc/>
    public override void OnContact(RuleWorld world, in RuleContact contact)
    {
        Note(world, Bits(contact.ClosingSpeed));
        Note(world, Bits(contact.Position.X));
        Count(world, contact.First);
        Count(world, contact.Second);
        if (world.Random(acts) == 0)
        {
            Act(world, world.Random(2) == 0 ? contact.First : contact.Second);
        }
    }

    /// <inheritdoc/>
    public override bool HearsCrossing(BodyId body, int sensor) => Mix(body.Packed, (ulong)sensor) % (ulong)contacts == 0;

    /// <inheritdoc/>
    public override void OnCrossing(RuleWorld world, in Crossing crossing)
    {
        Note(world, ((ulong)(uint)crossing.Sensor << 1) | (crossing.Entered ? 1UL : 0));
        Note(world, (ulong)world.Elapsed.Ticks);
        if (world.Random(acts) == 0)
        {
            Act(world, crossing.Body);
        }
    }

    /// <inheritdoc/>
    public override void OnTimer(RuleWorld world, int timer)
    {
        Note(world, (ulong)timer);
        if (timer < Timers)
        {
            world.SetTimer(timer, SimDuration.FromMilliseconds(30 + world.Random(200)));
        }

        BodyId body = Any(world);
        Note(world, world.TryReadHold(body, out Hold hold) ? Bits(hold.Offset.X) : 0);
        if (world.Scene.Sensors.Count > 0)
        {
            Note(world, world.IsInside(body, world.Random(world.Scene.Sensors.Count)) ? 1UL : 0);
        }

        if (world.TryRead(body, out BodyState state))
        {
            Note(world, Bits(state.Position.X));
            Note(world, Bits(state.Velocity.Y));
            Note(world, world.IsRoomFor(body, state.Position + new Vector3D(0, 0.5, 0)) ? 1UL : 0);
        }

        if (timer == 0)
        {
            Span<BodyId> near = stackalloc BodyId[8];
            int count = world.Within(state.Position, 1.5, near);
            Note(world, (ulong)count);
            body = count > 0 ? near[world.Random(Math.Min(count, near.Length))] : body;
        }

        Act(world, body);
    }

    /// <inheritdoc/>
    public override void OnSpawned(RuleWorld world, BodyId body)
    {
        Note(world, body.Packed);
        world.Tell(1, body.Index);
    }

    /// <inheritdoc/>
    public override void OnRemoved(RuleWorld world, BodyId body) => Note(world, ~body.Packed);

    private static ulong Bits(double value) => (ulong)BitConverter.DoubleToInt64Bits(value);

    private static ulong Mix(ulong a, ulong b)
    {
        StableHash hash = default;
        hash.Add(a);
        hash.Add(b);
        return hash.Value;
    }

    private static void Note(RuleWorld world, ulong what)
    {
        ref Total total = ref world.State<Total>();
        total.Digest = Mix(total.Digest, what);
        total.Calls++;
    }

    private static BodyId Any(RuleWorld world) => world.Scene.Bodies.Count == 0 ? default : BodyId.OfScene(world.Random(world.Scene.Bodies.Count));

    private void Count(RuleWorld world, BodyId body)
    {
        if (BodyBytes > 0 && world.TryRead(body, out _))
        {
            world.State<OfBody>(body).Hits++;
        }
    }

    private void Act(RuleWorld world, BodyId body)
    {
        Vector3D some = new((4 * world.RandomFraction()) - 2, (4 * world.RandomFraction()) - 2, (4 * world.RandomFraction()) - 2);
        ref Total total = ref world.State<Total>();
        switch (world.Random(14))
        {
            case 0:
            case 1:
            case 2:
                world.SetVelocity(body, some);
                break;
            case 3:
            case 4:
                world.Impulse(body, some * world.SpecOf(body).Mass);
                break;
            case 5 when body.Sequence == 0 && body.Peer == 0:
                Vector3D place = world.Scene.Bodies[body.Index].Position + ((total.Digest & 1) == 0 || world.Scene.Box.Exists ? default : some); // also into walls
                world.Teleport(body, place, some, (WhenOccupied)world.Random(3));
                break;
            case 6 when total.Spawns < MaxSpawns && world.Scene.Bodies.Count > 0:
                total.Spawns++;
                SceneBody like = world.Scene.Bodies[world.Random(world.Scene.Bodies.Count)];
                if ((total.Digest & 2) == 0)
                {
                    total.Last = world.Spawn(like.Spec, like.Position, some, whenOccupied: (WhenOccupied)world.Random(3)).Packed;
                }
                else if (world.TrySpawn(like.Spec, like.Position, out BodyId there, some))
                {
                    total.Last = there.Packed;
                }

                break;
            case 7 when total.Last != 0:
                world.Remove(BodyId.FromPacked(total.Last));
                break;
            case 8:
                world.SetTimer(Timers + world.Random(3), SimDuration.FromMilliseconds(world.Random(100)));
                break;
            case 9:
                world.CancelTimer(Timers + world.Random(3));
                break;
            case 10 when world.Scene.StaticSpheres.Count == 0: // what passes through a sphere that pulls ends in its centre
                world.SetFilter(body, world.Random(2) == 0 ? default : new CollisionFilter(2, 1));
                break;
            case 11 when world.Random(4) == 0: // not often, so that something stays to be played with
                world.Remove(body);
                break;
            case 12:
                world.Tell(2, (long)(total.Digest >> 8));
                break;
            default:
                total.Score++;
                break;
        }
    }

    /// <summary>The state of the world.</summary>
    internal struct Total
    {
        /// <summary>Everything that was heard, read and drawn.</summary>
        internal ulong Digest;

        /// <summary>The last body that was spawned.</summary>
        internal ulong Last;

        /// <summary>How often something was noted.</summary>
        internal long Calls;

        /// <summary>How often nothing else was done.</summary>
        internal int Score;

        /// <summary>How many bodies were spawned.</summary>
        internal int Spawns;
    }

    /// <summary>The state of a body.</summary>
    internal struct OfBody
    {
        /// <summary>How often it was in a contact that was heard.</summary>
        internal long Hits;
    }
}
