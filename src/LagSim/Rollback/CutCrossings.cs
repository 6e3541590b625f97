using System.Collections.Generic;
using LagSim.Events;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Rollback;

/// <summary>
/// The crossings of sensors that the current heal has cut, kept as long as they are few. Where the new paths reconverge with the old ones,
/// they are put back.
/// </summary>
/// <remarks>It allocates only until it has held as much as it ever does.</remarks>
internal class CutCrossings(CrossingLog log)
{
    private readonly List<(int Slot, Crossing Crossing)> kept = new(); // of each body the latest first
    private long lastSerial;

    /// <summary>The crossings that are left.</summary>
    internal CrossingLog Log { get; } = log;

    /// <summary>Whether everything that the heal has cut is here.</summary>
    internal bool IsWhole { get; private set; }

    /// <summary>Whether the heal has neither cut nor made a crossing.</summary>
    internal bool AreUntouched => kept.Count == 0 && Log.LastSerial == lastSerial;

    /// <summary>A heal begins.</summary>
    internal void Begin()
    {
        kept.Clear();
        IsWhole = true;
        lastSerial = Log.LastSerial;
    }

    /// <summary>Discards what was kept. The heal will run to its horizon.</summary>
    internal void GiveUp()
    {
        kept.Clear();
        IsWhole = false;
    }

    /// <summary>A body's crossings from a key on are about to be cut.</summary>
    internal void Keep(int slot, in EventKey from)
    {
        for (int at = Log.Last(slot); IsWhole && at != CrossingLog.None && EventKey.Compare(Log.Key(at), from) >= 0; at = Log.Previous(at))
        {
            if (Log.Serial(at) <= lastSerial)
            {
                kept.Add((slot, Log.At(at)));
                IsWhole = kept.Count <= CutPaths.Most;
            }
        }
    }

    /// <summary>
    /// Whether after everything up to and including a time a body is inside of the same sensors as before the heal, and has crossed the
    /// same since a key, that of its newest segment.
    /// </summary>
    internal virtual bool AreTheSame(int slot, in EventKey since, SimTime time)
    {
        int at = Log.Last(slot);
        for (int n = 0; n < kept.Count; n++)
        {
            Crossing old = kept[n].Crossing;
            if (kept[n].Slot != slot || old.Time > time || EventKey.Compare(old.Key, since) < 0)
            {
                continue;
            }

            if (!IsNew(at, since) || Log.At(at) != old)
            {
                return false;
            }

            at = Log.Previous(at);
        }

        if (IsNew(at, since))
        {
            return false;
        }

        bool isSame = true;
        for (int sensor = 0; sensor < Log.SensorCount && isSame; sensor++)
        {
            isSame = Log.IsInside(slot, sensor) == WasInside(slot, sensor, time);
        }

        return isSame;
    }

    /// <summary>Puts back the crossings cut after a time.</summary>
    internal virtual void PutBack(SimTime time)
    {
        for (int n = kept.Count - 1; n >= 0; n--)
        {
            if (kept[n].Crossing.Time > time)
            {
                Log.PutBack(kept[n].Slot, kept[n].Crossing.Key);
            }
        }
    }

    private bool IsNew(int at, in EventKey since) =>
        at != CrossingLog.None && Log.Serial(at) > lastSerial && EventKey.Compare(Log.Key(at), since) >= 0;

    /// <summary>Whether a body was inside before the heal: what the newest old crossing up to then made of it.</summary>
    private bool WasInside(int slot, int sensor, SimTime time)
    {
        for (int n = 0; n < kept.Count; n++)
        {
            if (kept[n].Slot == slot && kept[n].Crossing.Sensor == sensor && kept[n].Crossing.Time <= time)
            {
                return kept[n].Crossing.Entered;
            }
        }

        for (int n = kept.Count - 1; n >= 0; n--)
        {
            if (kept[n].Slot == slot && kept[n].Crossing.Sensor == sensor)
            {
                return !kept[n].Crossing.Entered; // the first that was cut, and it came later
            }
        }

        bool isInside = Log.IsInside(slot, sensor);
        for (int at = Log.Last(slot); at != CrossingLog.None && Log.Serial(at) > lastSerial; at = Log.Previous(at))
        {
            isInside ^= Log.At(at).Sensor == sensor;
        }

        return isInside;
    }
}
