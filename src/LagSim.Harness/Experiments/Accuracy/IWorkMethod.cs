using System;
using System.Collections.Generic;
using System.Threading;
using LagSim.Scenes;

namespace LagSim.Harness.Experiments.Accuracy;

/// <summary>
/// A way to simulate a scene: a law of LagSim, another engine, an integrator. A new one is one file and one line in
/// <see cref="WorkMethods"/>.
/// </summary>
public interface IWorkMethod
{
    /// <summary>What it is called in tables: <c>LagSim Ballistic</c>.</summary>
    string Name { get; }

    /// <summary>Whose it is, in one lower-case word: <c>lagsim</c>, <c>ode</c>. What <c>--peers</c> takes.</summary>
    string Engine { get; }

    /// <summary>Why it cannot run on this machine and how to get it, in a sentence; null if it can.</summary>
    string? Missing { get; }

    /// <summary>Why it is left out of a scene, in a sentence; null if it is not.</summary>
    string? Excludes(WorkScene scene);

    /// <summary>The settings to sweep, from coarse to fine; the first is the method's own default where it has one.</summary>
    IReadOnlyList<WorkSetting> Settings(WorkScene scene);

    /// <summary>Builds a world of the scene at time zero.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="setting">One of <see cref="Settings"/>.</param>
    /// <param name="cancellation">Ends <see cref="IWorkRun.AdvanceTo"/> between two steps or instants, by an
    /// <see cref="OperationCanceledException"/>.</param>
    IWorkRun Start(WorkScene scene, WorkSetting setting, CancellationToken cancellation);
}

/// <summary>A world of some engine on its way. Not thread-safe.</summary>
public interface IWorkRun : IDisposable
{
    /// <summary>Where it stands, in seconds since the start.</summary>
    double Seconds { get; }

    /// <summary>Events or steps so far.</summary>
    long Events { get; }

    /// <summary>Goes on to a time, or to the whole step that is nearest to it; never back.</summary>
    void AdvanceTo(double seconds);

    /// <summary>Where a body's centre is, in metres.</summary>
    Vector3D Position(int body);

    /// <summary>A body's velocity in m/s.</summary>
    Vector3D Velocity(int body);

    /// <summary>How a body turns, in rad/s about the vector; zero where nothing turns.</summary>
    Vector3D Spin(int body) => Vector3D.Zero;
}
