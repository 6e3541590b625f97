using System;
using LagSim.Contacts;
using LagSim.Scenes;
using LagSim.Time;
using Xunit;

namespace LagSim.Tests.Contacts;

/// <summary>What follows from a contact tolerance: a step in which a fall stays within it, speeds that go with it, and a clock whose ticks meet.</summary>
public sealed class ContactScaleTests
{
    private const double Gravity = 9.81;

    [Theory]
    [InlineData(1e-9)]
    [InlineData(1e-6)]
    [InlineData(3e-4)]
    [InlineData(1e-3)]
    [InlineData(0.1)]
    public void Step_IsTheLongestPowerOfTwoInWhichAFallStaysWithin(double d)
    {
        ContactScale scale = new(d, new Vector3D(0, -Gravity, 0), default);
        double h = scale.Step.ToSeconds();
        Assert.Equal(0, Math.Log2(h) % 1);
        Assert.InRange(0.5 * Gravity * h * h, 0, d);
        Assert.True(h == 1.0 / 64 || 0.5 * Gravity * (2 * h) * (2 * h) > d, "a longer one would do");
        Assert.Equal(d, scale.CaptureSpeed * scale.CaptureSpeed / (2 * Gravity), 1e-12 * d);
        Assert.True(scale.SweepSpeed * h < 0.01 * d && scale.SweepSpeed < scale.ImpactSpeed && scale.ImpactSpeed < scale.CaptureSpeed);
        Assert.Equal(d, scale.StillSpeed * 0.5, 1e-12 * d);
        Assert.Equal(d < 0.5 * Gravity / 64 / 64 * 4 ? d : 2 * Gravity / 64 / 64, scale.SpeculativeMargin, 1e-12 * d);
    }

    [Fact]
    public void Step_WithoutGravity_IsThatOfAPullOfOne() =>
        Assert.Equal(new ContactScale(1e-5, new Vector3D(0, -1, 0), default).Step, new ContactScale(1e-5, Vector3D.Zero, default).Step);

    [Fact]
    public void Ticks_OfAnyTwoClocks_MeetAtThoseOfTheLonger()
    {
        Random random = new(7);
        SimTime start = SimTime.FromSeconds(12.3456789);
        ContactScale scale = new(1e-3, new Vector3D(0, -Gravity, 0), start);
        int passed = 0;
        for (int n = 0; n < 1000; n++)
        {
            SimTime time = start + SimDuration.FromSeconds(random.NextDouble());
            double wanted = Math.Pow(2, -4 - (20 * random.NextDouble()));
            SimTime tick = scale.TickFrom(time, wanted), coarse = scale.TickFrom(time, double.PositiveInfinity);
            Assert.True(tick >= time && coarse >= tick && (tick - time).ToSeconds() < Math.Max(wanted, 1e-6));
            SimDuration length = scale.StepFrom(tick, wanted);
            Assert.True(length.ToSeconds() <= wanted || length.Ticks == ContactScale.ShortestTicks, $"{length.ToSeconds()} of {wanted}");
            Assert.Equal(0, (tick - start).Ticks % length.Ticks);
            Assert.Equal(0, (coarse - start).Ticks % scale.Step.Ticks);

            // It never steps over a tick of the longer clock, at which others may be, however long a step is wanted.
            Assert.False(Passes(tick, length));
            Assert.False(Passes(tick, scale.StepFrom(tick, double.PositiveInfinity)));
            passed += Passes(tick, scale.Step) ? 1 : 0;
        }

        Assert.InRange(passed, 500, 1000); // the control

        bool Passes(SimTime tick, SimDuration length) =>
            (tick - start).Ticks / scale.Step.Ticks != (tick + length - SimDuration.OneTick - start).Ticks / scale.Step.Ticks;
    }
}
