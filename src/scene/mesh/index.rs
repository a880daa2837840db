//! Which corners a face may name.

use super::fault::MeshFault;

/// The corners that there are so far.
#[derive(Clone, Copy, Debug)]
pub struct CornerNumbers {
    count: usize,
    /// The number of the first.
    first: i64,
}

impl CornerNumbers {
    /// Corners numbered from 0.
    pub const fn from_zero(count: usize) -> Self {
        Self { count, first: 0 }
    }

    /// Corners numbered from 1, or from the last backwards as −1, −2 and so on.
    pub const fn from_one(count: usize) -> Self {
        Self { count, first: 1 }
    }

    /// The place of the corner of this number.
    ///
    /// # Errors
    /// [`MeshFault::NoCorner`], and which numbers there are.
    pub fn corner(&self, index: i64) -> Result<u32, MeshFault> {
        let place = if self.first == 1 && index < 0 {
            index.checked_add_unsigned(self.count as u64)
        } else {
            index.checked_sub(self.first)
        };
        let inside =
            place.and_then(|place| u32::try_from(place).ok()).filter(|&at| (at as usize) < self.count);
        inside.ok_or_else(|| MeshFault::NoCorner { index, known: self.numbers() })
    }

    fn numbers(&self) -> String {
        match self.count {
            0 => "there are no corners before it".to_owned(),
            count => {
                let last = count - usize::from(self.first == 0);
                format!("they are numbered from {} to {last}", self.first)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_within_what_there_is() {
        let (zero, one) = (CornerNumbers::from_zero(3), CornerNumbers::from_one(3));
        assert_eq!([0, 2].map(|i| zero.corner(i)), [Ok(0), Ok(2)]);
        assert_eq!([1, 3, -1, -3].map(|i| one.corner(i)), [Ok(0), Ok(2), Ok(2), Ok(0)]);
        for index in [3, -1, i64::MAX, i64::MIN] {
            assert!(zero.corner(index).is_err(), "{index}");
        }
        for index in [0, 4, -4, i64::MAX, i64::MIN] {
            assert!(one.corner(index).is_err(), "{index}");
        }
        assert!(CornerNumbers::from_one(0).corner(1).unwrap_err().to_string().contains("no corners"));
    }
}
