using LagSim.Events;
using LagSim.Motion;
using LagSim.Scenes;
using LagSim.Time;
using LagSim.Timelines;

namespace LagSim.Collisions;

/// <summary>How a sensor moves: it stands still, or goes with its carrier on a segment of that body's path.</summary>
internal readonly struct SensorPath
{
    private readonly TimelineStore timelines;
    private readonly int piece; // of the carrier's path; none for a sensor that stands still

    private SensorPath(TimelineStore timelines, int piece)
    {
        this.timelines = timelines;
        this.piece = piece;
    }

    /// <summary>Whether the sensor is there.</summary>
    internal bool IsPresent => IsFixed || timelines.Segment(piece).IsPresent;

    /// <summary>Until when it moves so.</summary>
    internal SimTime End => IsFixed ? SimTime.MaxValue : timelines.Segment(piece).End;

    private bool IsFixed => piece == TimelineStore.None;

    private Paths Paths => new(timelines);

    /// <summary>A sensor that stands still.</summary>
    internal static SensorPath Fixed(TimelineStore timelines) => new(timelines, TimelineStore.None);

    /// <summary>A sensor whose carrier is on a segment.</summary>
    internal static SensorPath On(TimelineStore timelines, int piece) => new(timelines, piece);

    /// <summary>From when on both it and a body on a segment move so: the later of the keys that opened the two.</summary>
    internal EventKey OpenedWith(int segment)
    {
        EventKey own = timelines.Key(segment);
        return !IsFixed && EventKey.Compare(timelines.Key(piece), own) > 0 ? timelines.Key(piece) : own;
    }

    /// <summary>The first round of a tick in which something can follow from how it moves.</summary>
    internal uint RoundAfter(SimTime tick) => IsFixed ? 0 : Paths.RoundAfter(piece, tick);

    /// <summary>From where its place counts: where the carrier's centre is.</summary>
    internal Vector3D OriginAt(in ContactTime time) => IsFixed ? Vector3D.Zero : Paths.PositionAt(piece, time);

    /// <summary>How fast it moves, in m/s.</summary>
    internal double SpeedAt(in ContactTime time) => IsFixed ? 0 : Paths.VelocityAt(piece, time).Length;

    /// <summary>The path of the centre of a sphere.</summary>
    /// <param name="sensor">The sphere.</param>
    /// <param name="start">When the scene began.</param>
    /// <param name="dense">Its integrated path.</param>
    internal MotionSegment CentreOf(in Sensor sensor, SimTime start, out DenseOutput dense)
    {
        dense = IsFixed ? default : timelines.Dense(piece);
        return IsFixed
            ? MotionSegment.AtRest(start, sensor.Centre)
            : timelines.Segment(piece).At(timelines.Segment(piece).Position + sensor.Centre);
    }
}
