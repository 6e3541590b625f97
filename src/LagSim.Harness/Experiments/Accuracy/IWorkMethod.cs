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
    /// <summary>The name in tables: <c>LagSim Ballistic</c>.</summary>
    string Name { get; }

    /// <summary>The engine, in one lower-case word: <c>lagsim</c>, <c>ode</c>. The value of <c>--peers</c>.</summary>
    string Engine { get; }

    /// <summary>The reason why it cannot run on this machine and how to get it, in a sentence; null if it can.</summary>
    string? Missing { get; }

    /// <summary>Returns why it is left out of a scene, in a sentence; null if it is not.</summary>
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

/// <summary>A running world of some engine. Not thread-safe.</summary>
public interface IWorkRun : IDisposable
{
    /// <summary>The current time, in seconds since the start.</summary>
    double Seconds { get; }

    /// <summary>The number of events or steps so far.</summary>
    long Events { get; }

    /// <summary>Advances to a time, or to the nearest whole step. Never goes back.</summary>
    void AdvanceTo(double seconds);

    /// <summary>Returns the position of a body's centre, in metres.</summary>
    Vector3D Position(int body);

    /// <summary>Returns a body's velocity, in m/s.</summary>
    Vector3D Velocity(int body);

    /// <summary>Returns a body's angular velocity, in rad/s; zero where nothing turns.</summary>
    Vector3D Spin(int body) => Vector3D.Zero;
}
