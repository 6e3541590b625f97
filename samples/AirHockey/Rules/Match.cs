using System;
using System.Runtime.CompilerServices;
using LagSim.Time;

namespace AirHockey;

/// <summary>What is going on.</summary>
public enum Phase
{
    CountDown,
    Play,
    Over,
}

/// <summary>What a prize does for the player that takes it, until the next one appears.</summary>
public enum PrizeKind
{
    SecondPuck,
    FastPuck,
    Shield,
}

/// <summary>What the rules tell the screens: the code of a notice.</summary>
public enum Told
{
    Begins,
    Goal, // the value is that of a Goal
    Prize, // kind + 16 * player
    Won, // the side
}

/// <summary>The state of a match. It is part of the world, and heals with the motion.</summary>
public struct Match
{
    public const int GoalsToWin = 5;
    public static readonly SimDuration Length = SimDuration.FromSeconds(60);

    public ulong Prize; // the body that lies on the table, packed; 0 for none
    public ulong SecondPuck;
    public long Ends; // in ticks since the scene began
    public int Left;
    public int Right;
    public Phase Phase;
    public int Count; // of the count-down
    public int Shielded; // 1 + the side whose goal is closed; 0 for none
    public int Chats; // how many lines there were
    public int ChatFrom;
    public ChatLine Chat;
    public int Spare; // no padding: the size is a multiple of eight bytes

    /// <summary>Whether a side's goal has no shield.</summary>
    public readonly bool IsOpen(int side) => Shielded != 1 + side;

    /// <summary>Whether one side has won, so long after the scene began; without a lead at full time the next goal wins.</summary>
    public readonly bool IsDecided(SimDuration elapsed) => Math.Max(Left, Right) >= GoalsToWin || (elapsed.Ticks >= Ends && Left != Right);
}

/// <summary>The state of a puck: who touched it last, for each side; 1 + the player, 0 for none.</summary>
public struct PuckState
{
    public int Left;
    public int Right;

    public int this[int side]
    {
        readonly get => side == 0 ? Left : Right;
        set => (Left, Right) = side == 0 ? (value, Right) : (Left, value);
    }
}

/// <summary>The last line of chat, as bytes of UTF-8; zeros fill it up.</summary>
[InlineArray(MaxBytes)]
public struct ChatLine
{
    public const int MaxBytes = 64;
    private byte first;
}

/// <summary>Which side scored, who of it touched the puck last (-1 for nobody), and the score; it travels as the value of a notice.
/// </summary>
public readonly record struct Goal(int Side, int Player, int Left, int Right)
{
    public static Goal From(long value) =>
        new((int)(value & 1), (int)(value >> 8 & 255) - 1, (int)(value >> 16 & 255), (int)(value >> 24 & 255));

    public long ToValue() => (long)Side | (long)(Player + 1) << 8 | (long)Left << 16 | (long)Right << 24;
}
