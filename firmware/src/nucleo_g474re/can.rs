//! FDCAN1 as a classic CAN controller at 1 Mbit/s (RM0440, section 44).

use core::cell::RefCell;
use core::sync::atomic::{AtomicBool, Ordering};

use cortex_m::peripheral::NVIC;
use critical_section::Mutex;
use deictic_core::can::Frame;
use embedded_can::ErrorKind;
use embedded_can::nb::Can;
use heapless::Deque;
use nb::Error::WouldBlock;
use stm32_metapac::can::regs::{Ir, Txbar, Txbtie};
use stm32_metapac::can::vals::{Anfe, Anfs};
use stm32_metapac::{FDCAN1, FDCANRAM1, Interrupt, interrupt};

/// Frames that bridge the longest the loop is away; a frame takes 0.13 ms at least.
const QUEUE: usize = 16;

/// Places in the message RAM, in words: FIFO 0 and the transmit buffers, three elements of 18 words each.
const RECEIVED: usize = 0xb0 / 4;
const SENT: usize = 0x278 / 4;
const ELEMENT: usize = 18;

static ARRIVED: Mutex<RefCell<Deque<Frame, QUEUE>>> = Mutex::new(RefCell::new(Deque::new()));

/// Whether a frame found no room to be sent.
static WAITS: AtomicBool = AtomicBool::new(false);

/// A word of the controller's message RAM.
fn word(at: usize) -> *mut u32 {
    (FDCANRAM1.as_ptr() as *mut u32).wrapping_add(at)
}

/// The controller on the bus.
pub struct Fdcan(());

impl Fdcan {
    /// Takes the controller, which has its clock of 24 MHz, onto the bus.
    pub(super) fn start() -> Self {
        FDCAN1.cccr().modify(|w| w.set_init(true));
        FDCAN1.cccr().modify(|w| w.set_cce(true));
        // 24 quanta of 1/24 us: 1 + 19 to the sample point at 83 %, 4 after it.
        FDCAN1.nbtp().write(|w| {
            w.set_nbrp(0);
            w.set_ntseg1(18);
            w.set_ntseg2(3);
            w.set_nsjw(3);
        });
        FDCAN1.rxgfc().write(|w| {
            w.set_anfs(Anfs::ACCEPT_FIFO_0);
            w.set_anfe(Anfe::REJECT);
            w.set_rrfs(true);
            w.set_rrfe(true);
        });
        FDCAN1.ie().write(|w| {
            w.set_rfne(0, true);
            w.set_tce(true);
            w.set_boe(true);
        });
        FDCAN1.txbtie().write_value(Txbtie(0b111));
        FDCAN1.ile().write(|w| w.set_eint0(true));
        FDCAN1.cccr().modify(|w| w.set_init(false));
        // SAFETY: the handler shares data with the loop only inside critical sections.
        unsafe { NVIC::unmask(Interrupt::FDCAN1_IT0) };
        Self(())
    }
}

/// There is a frame to take, or room for one that found none.
pub(super) fn is_due() -> bool {
    let arrived = critical_section::with(|cs| {
        let queue = ARRIVED.borrow(cs).try_borrow();
        queue.is_ok_and(|queue| !queue.is_empty())
    });
    arrived || WAITS.load(Ordering::Relaxed) && FDCAN1.txfqs().read().tffl() > 0
}

impl Can for Fdcan {
    type Frame = Frame;
    type Error = ErrorKind;

    fn transmit(&mut self, frame: &Frame) -> nb::Result<Option<Frame>, ErrorKind> {
        let state = FDCAN1.txfqs().read();
        WAITS.store(state.tfqf(), Ordering::Relaxed);
        if state.tfqf() {
            return Err(WouldBlock);
        }
        let place = usize::from(state.tfqpi().min(2));
        let at = SENT.wrapping_add(place.wrapping_mul(ELEMENT));
        let mut data = [0; 8];
        for (to, from) in data.iter_mut().zip(frame.data()) {
            *to = *from;
        }
        let [a, b, c, d, e, f, g, h] = data;
        let length = frame.data().len() as u32;
        let words = [
            u32::from(frame.id()) << 18,
            length << 16,
            u32::from_le_bytes([a, b, c, d]),
            u32::from_le_bytes([e, f, g, h]),
        ];
        for (offset, value) in words.into_iter().enumerate() {
            // SAFETY: one of the first four words of one of the three transmit buffers, which the controller does not
            // read before it is asked to below.
            unsafe { word(at.wrapping_add(offset)).write_volatile(value) };
        }
        FDCAN1.txbar().write_value(Txbar(1 << place));
        Ok(None)
    }

    fn receive(&mut self) -> nb::Result<Frame, ErrorKind> {
        let arrived = critical_section::with(|cs| {
            let mut queue = ARRIVED.borrow(cs).try_borrow_mut().ok()?;
            queue.pop_front()
        });
        arrived.ok_or(WouldBlock)
    }
}

/// Takes a frame out of FIFO 0; `None` when it is empty.
fn take() -> Option<Option<Frame>> {
    let state = FDCAN1.rxfs(0).read();
    if state.ffl() == 0 {
        return None;
    }
    let place = state.fgi().min(2);
    let at = RECEIVED.wrapping_add(usize::from(place).wrapping_mul(ELEMENT));
    // SAFETY: the first four words of the element that the controller has filled and left to us.
    let [head, length, low, high] =
        [0, 1, 2, 3].map(|offset| unsafe { word(at.wrapping_add(offset)).read_volatile() });
    FDCAN1.rxfa(0).write(|w| w.set_fai(place));
    let mut data = [0; 8];
    let bytes = low.to_le_bytes().into_iter().chain(high.to_le_bytes());
    for (to, from) in data.iter_mut().zip(bytes) {
        *to = from;
    }
    let length = ((length >> 16 & 0xf) as usize).min(8);
    Some(Frame::new((head >> 18 & 0x7ff) as u16, data.get(..length)?))
}

#[interrupt]
fn FDCAN1_IT0() {
    let causes = FDCAN1.ir().read();
    FDCAN1.ir().write_value(Ir(causes.0));
    if FDCAN1.psr().read().bo() {
        // Off the bus the controller has gone back to initialisation; it joins again after 129 idle periods.
        FDCAN1.cccr().modify(|w| w.set_init(false));
    }
    while let Some(frame) = take() {
        critical_section::with(|cs| {
            // What finds no room is lost, which the stream's own frames show.
            if let (Some(frame), Ok(mut queue)) = (frame, ARRIVED.borrow(cs).try_borrow_mut()) {
                let _ = queue.push_back(frame);
            }
        });
    }
}
