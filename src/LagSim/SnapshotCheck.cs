using LagSim.Contacts;
using LagSim.Events;
using LagSim.Motion;
using LagSim.Rules;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim;

/// <summary>Checks that a snapshot can be of a world of a scene; it may come from anywhere.</summary>
/// <remarks>
/// It checks each body alone. It does not check whether bodies overlap, or whether a path is one that this world would have taken.
/// </remarks>
internal static class SnapshotCheck
{
    internal static void Throw(WorldSnapshot snapshot, Scene scene)
    {
        if (!Limits.IsStart(snapshot.Start) || snapshot.Time > Limits.LatestTime || snapshot.Time <= snapshot.Start)
        {
            throw new SceneException(
                $"The snapshot is of {snapshot.Time.ToShortString()} in a world that began at {snapshot.Start.ToShortString()}; a world begins within 72 days"
                + $" of the origin, and lasts until {Limits.LatestTime.ToShortString()} at most, and the first comes after the second.");
        }

        StateLayout.Check(snapshot.RuleStateArray, scene.Rules, (snapshot.Time - snapshot.Start).Ticks);
        BodySnapshot[] bodies = snapshot.BodyArray;
        for (int i = 0; i < bodies.Length; i++)
        {
            if (i > 0 && bodies[i].Id <= bodies[i - 1].Id)
            {
                throw new SceneException($"In the snapshot body {bodies[i].Id} follows body {bodies[i - 1].Id}; identities must ascend.");
            }

            CheckBody(bodies[i], snapshot, scene);
        }
    }

    private static void CheckBody(in BodySnapshot body, WorldSnapshot snapshot, Scene scene)
    {
        string whose = $"body {body.Id} in the snapshot";
        if (body.Id.Sequence == 0 && (body.Id.Peer != 0 || body.Id.Index >= scene.BodyArray.Length))
        {
            throw new SceneException(
                $"The snapshot has body {body.Id}; the scene has {Limits.Count(scene.BodyArray.Length, "body", "bodies")} of its own. It is of another scene.");
        }

        Limits.CheckSpec(body.Spec, whose, scene.Gravity, scene.ForceArray);
        if (body.Spec.Radius < scene.SmallestRadius)
        {
            throw new SceneException(
                $"The radius of {whose} is {Limits.Text(body.Spec.Radius)} m; the scene promises none below {Limits.Text(scene.SmallestRadius)} m.");
        }

        CheckTimes(body, snapshot, whose);
        if (scene.Box.Exists)
        {
            Limits.CheckInBox(body.Spec, body.Position, scene.Box, whose);
            if (body.Law != MotionLaw.Ballistic)
            {
                throw new SceneException($"The motion of {whose} is {body.Law}; in a periodic box it is Ballistic.");
            }
        }

        Limits.Components(body.Position, double.MaxValue, whose, "position", "m");
        Limits.Components(body.Velocity, Limits.MaxSpeed(scene.SmallestRadius), whose, "velocity", "m/s");
        Limits.Components(body.Acceleration, double.MaxValue, whose, "acceleration", "m/s^2");
        Limits.Components(body.Cubic, double.MaxValue, whose, "cubic coefficient", "m/s^3");
        Limits.Components(body.Quartic, double.MaxValue, whose, "quartic coefficient", "m/s^4");
        Limits.Components(body.Quintic, double.MaxValue, whose, "quintic coefficient", "m/s^5");
        if (body.Law != body.Spec.Flight
            && body.Law is not (MotionLaw.Sliding or MotionLaw.Rolling or MotionLaw.Resting or MotionLaw.Held or MotionLaw.Constrained))
        {
            throw new SceneException(
                $"The motion of {whose} is {body.Law}; it must be Sliding, Rolling, Resting, Held, Constrained, or its law of flight, {body.Spec.Flight}.");
        }

        Limits.Components(body.Spin, double.MaxValue, whose, "spin", "rad/s");
        Limits.Components(body.SpinRate, double.MaxValue, whose, "rate of spin", "rad/s^2");
        if (body.NextStep != SimDuration.Zero && (body.NextStep < StepSize.Shortest || body.NextStep > StepSize.Longest))
        {
            throw new SceneException(
                $"The next step of {whose} is {body.NextStep.ToShortString()}; it must lie between {StepSize.Shortest.ToShortString()} and"
                + $" {StepSize.Longest.ToShortString()}, or be 0.");
        }

        bool isCarried = body.Law is MotionLaw.Sliding or MotionLaw.Rolling;
        if (isCarried != body.SupportCount > 0 && body.Law != MotionLaw.Resting)
        {
            throw new SceneException(
                $"{Limits.Count(body.SupportCount, "plane carries", "planes carry")} {whose}, which is {body.Law}; what slides or rolls is carried, what"
                    + " rests may be, and nothing else is.");
        }

        if (body.Law == MotionLaw.Resting && body.End != SimTime.MaxValue)
        {
            throw new SceneException(
                $"The rest of {whose} ends at {body.End.ToShortString()}; it lasts until something else happens, so its end must be"
                + $" {SimTime.MaxValue.ToShortString()}.");
        }

        CheckContacts(body, scene, whose);
        for (int n = 0; n < body.SupportCount; n++)
        {
            int plane = body.Support(n);
            if (plane < (n == 0 ? 0 : body.Support(n - 1) + 1) || plane >= scene.Planes.Count)
            {
                throw new SceneException($"Plane {plane} carries {whose}; planes are numbered 0 to {scene.Planes.Count - 1} and named in ascending order.");
            }
        }

        CheckHold(body, snapshot, whose);
        CheckCrossings(body, snapshot, scene, whose);
    }

    private static void CheckCrossings(in BodySnapshot body, WorldSnapshot snapshot, Scene scene, string whose)
    {
        int before = -1;
        foreach (int sensor in body.InsideArray)
        {
            if (sensor <= before || sensor >= scene.SensorArray.Length)
            {
                throw new SceneException(
                    $"Sensor {sensor} has {whose} inside; the scene has {Limits.Count(scene.SensorArray.Length, "sensor")}, numbered from 0 and named in"
                    + " ascending order.");
            }

            before = sensor;
            CheckCarrier(scene.SensorArray[sensor], body.Id, whose);
        }

        for (int n = 0; n < body.CrossingArray.Length; n++)
        {
            Crossing crossing = body.CrossingArray[n];
            EventKey least = n == 0 ? body.Opened : body.CrossingArray[n - 1].Key;
            if (crossing.Body != body.Id || crossing.Key.Other != body.Id || crossing.Key.Peer != 0 || crossing.Sensor < 0
                || crossing.Sensor >= scene.SensorArray.Length || EventKey.Compare(crossing.Key, least) <= 0 || crossing.Time >= snapshot.Time)
            {
                throw new SceneException(
                    $"In the snapshot {crossing}, in the path of {whose}; it must be of that body, of one of {Limits.Count(scene.SensorArray.Length, "sensor")},"
                    + $" after {least} and before {snapshot.Time.ToShortString()}.");
            }

            CheckCarrier(scene.SensorArray[crossing.Sensor], body.Id, whose);
        }

        CheckSides(body, whose);
    }

    private static void CheckCarrier(in Sensor sensor, BodyId body, string whose)
    {
        if (sensor.Carrier == body)
        {
            throw new SceneException($"In the snapshot sensor '{sensor.Name}' sees {whose}, which carries it; no sensor sees its carrier.");
        }
    }

    /// <summary>What enters a sensor was outside of it, and what leaves was inside.</summary>
    private static void CheckSides(in BodySnapshot body, string whose)
    {
        for (int n = body.CrossingArray.Length - 1; n >= 0; n--)
        {
            Crossing crossing = body.CrossingArray[n];
            int later = n + 1;
            while (later < body.CrossingArray.Length && body.CrossingArray[later].Sensor != crossing.Sensor)
            {
                later++;
            }

            bool isInside = later < body.CrossingArray.Length
                ? !body.CrossingArray[later].Entered
                : System.Array.IndexOf(body.InsideArray, crossing.Sensor) >= 0;
            if (crossing.Entered != isInside)
            {
                throw new SceneException($"In the snapshot {crossing}, in the path of {whose}, which is {(isInside ? "inside" : "outside")} after that.");
            }
        }
    }

    private static void CheckContacts(in BodySnapshot body, Scene scene, string whose)
    {
        bool isMember = body.Segment.IsOfIsland;
        if (!isMember && (body.Contacts.Length > 0 || body.Centre != default || body.StillSince != default))
        {
            throw new SceneException(
                $"The motion of {whose} is {body.Law}; only what is Constrained, or rests and no plane carries it, has persistent contacts.");
        }

        SimDuration longest = new ContactScale(scene.ContactTolerance, scene.Gravity, default).Step;
        bool isStep = body.Law == MotionLaw.Constrained;
        if (isStep && (body.Epoch != body.Opened.Time || body.End < body.Epoch || body.End - body.Epoch > longest))
        {
            throw new SceneException(
                $"The step of {whose}, which is Constrained, lasts from {body.Epoch.ToShortString()} to {body.End.ToShortString()} and was opened at"
                + $" {body.Opened.Time.ToShortString()}; it must begin where it was opened and last at most {longest.ToShortString()}.");
        }

        if (isMember && (body.StillSince > body.Opened.Time || body.Centre > body.Opened.Time + longest || (isStep && body.Centre < body.Opened.Time - longest)))
        {
            throw new SceneException(
                $"The velocity of {whose} is of {body.Centre.ToShortString()}, and it is still since {body.StillSince.ToShortString()}; the first must lie within a"
                + $" step, {longest.ToShortString()}, of {body.Opened.Time.ToShortString()}, when its path was opened, and the second not after.");
        }

        int surfaces = scene.PlaneArray.Length + scene.SphereArray.Length;
        foreach (PersistentContact contact in body.ContactArray)
        {
            bool isPair = contact.Surface == PersistentContact.NoSurface;
            if (contact.Surface < PersistentContact.NoSurface || contact.Surface >= surfaces || isPair == (contact.Partner == body.Id))
            {
                throw new SceneException(
                    $"A contact of {whose} is with surface {contact.Surface} and body {contact.Partner}; a surface is numbered 0 to {surfaces - 1} and goes with"
                    + $" the body itself, and {PersistentContact.NoSurface} goes with another.");
            }

            if (contact.Solved && !(contact.Holds && !isPair && body.Opened.Kind == EventKind.Impact))
            {
                throw new SceneException(
                    $"A contact of {whose} is solved; only a surface that holds can be, and only after an impact, but this is {(isPair ? "a body" : "a surface")},"
                    + $" it {(contact.Holds ? "holds" : "does not hold")}, and the path was opened by {body.Opened.Kind}.");
            }

            Limits.Components(contact.Push, double.MaxValue, whose, "impulse of a contact", "N s");
            Limits.Components(contact.Turn, double.MaxValue, whose, "angular impulse of a contact", "N m s");
        }
    }

    private static void CheckHold(in BodySnapshot body, WorldSnapshot snapshot, string whose)
    {
        Hold hold = body.Hold;
        if (body.Law != MotionLaw.Held)
        {
            return;
        }

        Limits.Components(hold.Offset, Limits.MaxCoordinate, whose, "offset of the hand", "m");
        Limits.InRange(hold.MaxForce, 0, Limits.MaxStrength, whose, "hand's greatest force", "N");
        Limits.InRange(hold.MaxPower, 0, Limits.MaxStrength, whose, "hand's greatest power", "W");
        SimTime busy = hold.BusyUntil;
        if (busy != default && (busy <= body.Opened.Time || busy > body.Opened.Time + HandPath.Settles))
        {
            throw new SceneException(
                $"The hand that holds {whose} is busy until {busy}; it must be after {body.Opened.Time.ToShortString()}, at which its path was opened, and no"
                + $" more than {HandPath.Settles} after.");
        }

        bool isPast = hold.KeyframeTime >= snapshot.Start && hold.KeyframeTime <= body.Epoch;
        SimTime told = hold.KeyframeTime;
        bool isAnEnd = body.End == told + HandPath.Settles || body.End == told + HandPath.Stops || body.End == told + HandPath.Lasts;
        if (!isPast || !isAnEnd)
        {
            throw new SceneException(
                $"The hand that holds {whose} last told where it is at {hold.KeyframeTime}, and this segment lasts from {body.Epoch.ToShortString()} to"
                + $" {body.End.ToShortString()}; it must not begin before, and end {HandPath.Settles}, {HandPath.Stops} or {HandPath.Lasts} after.");
        }
    }

    private static void CheckTimes(in BodySnapshot body, WorldSnapshot snapshot, string whose)
    {
        EventKey opened = body.Opened;
        bool isKnown = opened.Kind is EventKind.Start or EventKind.Impact or EventKind.StepEnd
            or (>= EventKind.Spawn and <= EventKind.Release) or EventKind.SetFilter || (opened.Kind is EventKind.Remove or EventKind.Lost && opened.Body != body.Id); // what it lay on is gone
        if (!isKnown || opened.Time < snapshot.Start || opened.Time >= snapshot.Time)
        {
            throw new SceneException(
                $"The path of {whose} was opened by {opened}; it must be an event that opens one, from {snapshot.Start.ToShortString()} on and before"
                + $" {snapshot.Time.ToShortString()}.");
        }

        if (body.Epoch < snapshot.Start || body.Epoch > opened.Time || body.End < snapshot.Time)
        {
            throw new SceneException(
                $"The path of {whose} counts from {body.Epoch.ToShortString()} and ends at {body.End.ToShortString()}; it must count from between"
                + $" {snapshot.Start.ToShortString()} and {opened.Time.ToShortString()}, and last to {snapshot.Time.ToShortString()}.");
        }
    }
}
