using System;
using LagSim.Time;

namespace LagSim.Net.Wire;

/// <summary>How the hand on a held body of a snapshot is encoded: how strong it is, and until when it is busy with what it struck.</summary>
/// <remarks>Values that are the default are left out. Pure functions, safe on any thread, without allocation.</remarks>
internal static class HandFormat
{
    /// <summary>The largest value of what a body has, with a hand.</summary>
    internal const byte MaxHas = (2 * BusyFlag) - 1;

    private const byte StrengthFlag = 16;
    private const byte BusyFlag = 32;

    /// <summary>What a hand has that is not the default, as bits.</summary>
    internal static int Has(in Hold hold) => (SaysStrength(hold) ? StrengthFlag : 0) | (IsBusy(hold) ? BusyFlag : 0);

    /// <summary>How long that is, in bytes.</summary>
    internal static int Length(in Hold hold) => (SaysStrength(hold) ? 2 * sizeof(double) : 0) + (IsBusy(hold) ? sizeof(long) : 0);

    /// <summary>Writes what a hand has.</summary>
    internal static void Write(ref WireWriter writer, in Hold hold)
    {
        if (SaysStrength(hold))
        {
            writer.WriteDouble(hold.MaxForce);
            writer.WriteDouble(hold.MaxPower);
        }

        if (IsBusy(hold))
        {
            writer.WriteInt64(hold.BusyUntil.Ticks);
        }
    }

    /// <summary>Reads the values of a hand that the bits announce; the reader refuses malformed ones.</summary>
    internal static Hold Read(ref WireReader reader, in Hold hold, byte has)
    {
        bool saysStrength = (has & StrengthFlag) != 0;
        bool isBusy = (has & BusyFlag) != 0;
        double maxForce = saysStrength ? ReadStrength(ref reader) : 0;
        double maxPower = saysStrength ? ReadStrength(ref reader) : 0;
        SimTime busy = isBusy ? SimTime.FromTicks(reader.ReadInt64()) : default;
        reader.Require((!saysStrength || maxForce != 0 || maxPower != 0) && isBusy == (busy != default)); // exactly one encoding
        return new Hold(hold.Peer, hold.Offset, hold.KeyframeTime, maxForce, maxPower, busy);
    }

    /// <summary>Reads a force or a power: finite, not below zero and not -0.0, which would be a second encoding of none.</summary>
    private static double ReadStrength(ref WireReader reader)
    {
        long bits = reader.ReadInt64();
        double value = BitConverter.Int64BitsToDouble(bits);
        reader.Require(bits >= 0 && value <= double.MaxValue);
        return value;
    }

    private static bool SaysStrength(in Hold hold) => hold.MaxForce != 0 || hold.MaxPower != 0;

    private static bool IsBusy(in Hold hold) => hold.BusyUntil != default;
}
