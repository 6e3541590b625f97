namespace LagSim.Events;

/// <summary>
/// The kind of an event. The number is its rank in the canonical order of one tick and round, and is part of wire, recordings and hashes:
/// never renumber.
/// </summary>
/// <remarks>
/// External events precede those that the model makes, and a spawn precedes all, so that other events at the tick of a body's spawn find it
/// there. An impact precedes the end of a step, so that a contact in a step's last tick is found on the step that it ends. A crossing
/// comes last: it changes no path, and is found on what all else of its tick and round has left.
/// </remarks>
public enum EventKind : byte
{
    /// <summary>No event; never in a timeline.</summary>
    None = 0,

    /// <summary>A body of a scene is there from the start.</summary>
    Start = 1,

    /// <summary>External: a body appears.</summary>
    Spawn = 8,

    /// <summary>External: a body is placed somewhere, with a velocity.</summary>
    Teleport = 9,

    /// <summary>External: a body's velocity is set.</summary>
    SetVelocity = 10,

    /// <summary>External: a body gets an impulse.</summary>
    Impulse = 11,

    /// <summary>External: a hand grabs a body. It has no effect on a body that is held already.</summary>
    Grab = 12,

    /// <summary>External: the position and velocity of the hand that holds a body. Without one for a second the hold ends.</summary>
    HoldKeyframe = 13,

    /// <summary>External: the hand that holds a body releases it, with a velocity.</summary>
    Release = 14,

    /// <summary>External: a body disappears.</summary>
    Remove = 15,

    /// <summary>
    /// External: the host says that a player joined, is away, returned or left. It comes before the commands of its tick, so that a player's
    /// first finds it there.
    /// </summary>
    Player = 16,

    /// <summary>External: what a body collides with changes. It comes after a removal, so of what is removed at that tick it changes nothing.</summary>
    SetFilter = 17,

    /// <summary>External: a player tells the game's rules something.</summary>
    Command = 18,

    /// <summary>A timer that the game's rules have set is due.</summary>
    Timer = 24,

    /// <summary>Segments touch.</summary>
    Impact = 32,

    /// <summary>An integrator's step ends, or the time for which a law holds.</summary>
    StepEnd = 33,

    /// <summary>A body enters or leaves a sensor. It opens no segment.</summary>
    Crossing = 34,

    /// <summary>
    /// A body whose motion cannot be followed leaves the world. It comes after all else of its tick and round; its sequence is the
    /// <see cref="Scenes.LossReason"/>.
    /// </summary>
    Lost = 35,
}
